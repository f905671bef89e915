// Drives the page (./dev web) in Chromium: opens a scene, renders it, asks a pixel for its rays, edits, copies, saves, loads again.
// Usage: node page_test.mjs PAGE-FOLDER SHOTS-FOLDER
import { mkdtempSync, readFileSync, readdirSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import path from 'node:path';
import { gzipSync } from 'node:zlib';
import { check, drive, folder } from './driver.mjs';

await drive({}, async (studio) => {
  const { page } = studio;
  const began = Date.now();
  await studio.load('');
  await studio.until(/\S/, 'the studio runs');
  console.log('        after ' + (Date.now() - began) + ' ms');
  await studio.wait(6000);
  await studio.shot('start');

  const first = Date.now();
  await studio.load('#scene=glass.ray&width=300&pixel=120,90');
  await studio.until(/^logged rendered/m, 'a scene named in the address is rendered');
  console.log('        first picture after ' + (Date.now() - first) + ' ms');
  await studio.until(/^pixel 120 90$/m, 'the pixel of the address is chosen');
  await studio.until(/^why \S/m, 'its colour is explained');
  await studio.wait(1500);
  await studio.shot('scene');

  const [x, y] = await studio.place('picture');
  await page.mouse.click(x - 60, y + 30, { delay: 60 });
  const clicked = (await studio.until(/^pixel (?!120 90)/m, 'a click chooses another pixel')).match(/^pixel (.*)$/m)[1];

  // Text: copied, and pasted.
  await studio.click('find an option');
  await page.keyboard.type('samples');
  await studio.until(/^(?![\s\S]* option depth$)/m, 'text finds options');
  await page.keyboard.press('Control+A');
  await page.keyboard.press('Control+C');
  await studio.wait(500);
  check(await page.evaluate(() => navigator.clipboard.readText()) === 'samples', 'Ctrl+C copies text');
  await page.evaluate(() => navigator.clipboard.writeText('depth'));
  await page.keyboard.press('Control+A');
  await page.keyboard.press('Control+V');
  await studio.until(/^at .* option depth$/m, 'Ctrl+V pastes text of other programs');

  // An edit.
  await studio.click('panel Scene');
  await studio.click('entry object 2');
  await page.keyboard.press('Control+D');
  await studio.until(/^objects 23$/m, 'an object is duplicated');
  await studio.until(/^edited yes$/m, 'the scene is edited');
  await studio.shot('panel');

  // The page is loaded again.
  await page.reload();
  await studio.until(/^objects 23$/m, 'a page that is loaded again has the scene as it was');
  await studio.until(/^file glass\.ray$/m, 'by its name');
  await studio.until(new RegExp('^pixel ' + clicked + '$', 'm'), 'and its pixel');
  await studio.until(/^logged rendered/m, 'and renders it');

  // Files for the person's disk.
  for (const [entry, pattern] of [['Save scene', /\.ray$/], ['Export picture...', /\.png$/]]) {
    const download = page.waitForEvent('download', { timeout: 30000 });
    await studio.choose('File', entry);
    if (entry.endsWith('...')) {
      await studio.wait(1000);
      await studio.shot('dialog');
      await page.keyboard.press('Enter');
    }
    const saved = await download;
    check(pattern.test(saved.suggestedFilename()), entry + ' gives ' + saved.suggestedFilename());
    const bytes = readFileSync(await saved.path());
    check(entry === 'Save scene' ? bytes.includes('camera') : bytes[1] === 80, 'it has what its name says');
  }

  // A link holds the scene and the pixel.
  await studio.choose('File', 'Copy link');
  await studio.wait(1500);
  const link = page.url();
  check(/#text=[\w-]+&width=300&pixel=\d+,\d+$/.test(link), 'the link holds text, options and pixel: ' + link.slice(0, 60) + '... (' + link.length + ' characters)');
  await page.goto('about:blank');
  await page.goto(link);
  await studio.until(/^file link\.ray$/m, 'the link opens');
  await studio.until(new RegExp(`^pixel ${clicked}$`, 'm'), 'and its pixel is chosen');
  await studio.until(/^why \S/m, 'and explained');
  await studio.shot('link');

  // A file of the computer.
  await studio.load('');
  await studio.until(/^at .* menu File$/m, 'the page loads again');
  const scene = path.join(mkdtempSync(path.join(tmpdir(), 'trace-scene-')), 'mine.ray');
  writeFileSync(scene, 'Trace 1\nsphere { material = { diffuse = (1, 0, 0) } }\n');
  await page.setInputFiles('#files', scene);
  await studio.until(/^file mine\.ray$/m, 'a file of the computer opens');
  await studio.until(/^logged rendered/m, 'and is rendered', 120);
  await studio.shot('own');
  await page.reload();
  await studio.until(/^file mine\.ray$/m, 'it is there when the page is loaded again');

  for (const [width, height] of [[900, 600], [1920, 1080]]) {
    await page.setViewportSize({ width, height });
    await studio.load('#scene=glass.ray&width=300&pixel=120,90');
    await studio.until(/^why \S/m, 'the page at ' + width + ' x ' + height);
    await studio.wait(2000);
    await studio.shot(width + 'x' + height);
  }
  let bytes = 0;
  for (const name of readdirSync(folder)) bytes += gzipSync(readFileSync(path.join(folder, name)), { level: 9 }).length;
  console.log('        ' + (bytes / 1e6).toFixed(2) + ' MB compressed');
  check(bytes < 8e6, 'at most 8 MB');
});
