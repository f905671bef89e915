// Drives the page (./dev web) in Chromium: opens a scene, renders it, asks a pixel for its rays, edits, saves, loads again.
// Usage: node page_test.mjs PAGE-FOLDER SHOTS-FOLDER; playwright-core is found from the working folder.
import { spawn } from 'node:child_process';
import { createRequire } from 'node:module';
import { mkdtempSync, mkdirSync, readFileSync, readdirSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import path from 'node:path';
import { gzipSync } from 'node:zlib';

const { chromium } = createRequire(path.join(process.cwd(), 'x.js'))('playwright-core');
const [folder, shots] = process.argv.slice(2);
mkdirSync(shots, { recursive: true });
const here = path.dirname(new URL(import.meta.url).pathname);

const server = spawn('python3', [path.join(here, '../../web/serve.py'), folder, '0']);
const address = await new Promise((found) => server.stdout.on('data', (text) => found(String(text).trim())));

const context = await chromium.launchPersistentContext(mkdtempSync(path.join(tmpdir(), 'trace-page-')), {
  executablePath: '/usr/bin/chromium', headless: true, viewport: { width: 1280, height: 800 }, acceptDownloads: true,
  args: ['--no-sandbox', '--disable-quic', '--no-first-run', '--disable-background-networking', '--disable-component-update',
         '--disable-sync', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader'],
});
let failures = 0;
const check = (holds, what) => {
  console.log((holds ? 'ok      ' : 'FAILED  ') + what);
  if (!holds) ++failures;
};

const outside = [];
const page = await context.newPage();
page.on('pageerror', (error) => check(false, 'no error in the page: ' + error.message));
page.on('request', (request) => { if (!/^(http:\/\/localhost|data:|blob:)/.test(request.url())) outside.push(request.url()); });

const stateText = () => page.evaluate(() => Module.ready ? Module.ccall('traceState', 'string', [], []) : '');
async function until(pattern, what, seconds = 60) {
  for (const end = Date.now() + seconds * 1000; Date.now() < end;) {
    const text = await stateText().catch(() => '');
    if (pattern.test(text)) { check(true, what); return text; }
    await page.waitForTimeout(100);
  }
  await page.screenshot({ path: path.join(shots, 'failed.png') });
  check(false, what);
  console.log(await stateText().catch((error) => String(error)));
  throw new Error(what);
}
/// The middle of what `state` names.
async function place(name) {
  const text = await until(new RegExp('^at -?\\d+ -?\\d+ ' + name.replace(/[.*+?^${}()|[\]\\]/g, '\\$&') + '$', 'm'), 'there is "' + name + '"', 20);
  const line = text.split('\n').find((each) => each.startsWith('at ') && each.endsWith(' ' + name));
  return line.split(' ').slice(1, 3).map(Number);
}
async function click(name) { await page.mouse.click(...await place(name), { delay: 60 }); }
/// An entry of a menu.
async function choose(menu, entry) {
  await click('menu ' + menu);
  await page.waitForTimeout(400);
  await click('action ' + entry);
}
const shot = (name) => page.screenshot({ path: path.join(shots, name + '.png') });

try {
  const began = Date.now();
  await page.goto(address);
  await until(/\S/, 'the studio runs');
  console.log('        after ' + (Date.now() - began) + ' ms');
  await page.waitForTimeout(6000);
  await shot('start');

  await page.goto('about:blank');
  const first = Date.now();
  await page.goto(address + '#scene=glass.ray&width=300&pixel=120,90');
  await until(/^logged rendered/m, 'a scene named in the address is rendered');
  console.log('        first picture after ' + (Date.now() - first) + ' ms');
  await until(/^pixel 120 90$/m, 'the pixel of the address is chosen');
  await until(/^why \S/m, 'its colour is explained');
  await page.waitForTimeout(1500);
  await shot('scene');

  const [x, y] = await place('picture');
  await page.mouse.click(x - 60, y + 30, { delay: 60 });
  await until(/^pixel (?!120 90)/m, 'a click chooses another pixel');

  // An edit, and the file of it.
  await click('panel Scene');
  await page.waitForTimeout(800);
  await shot('panel');
  const before = page.waitForEvent('download', { timeout: 30000 });
  await choose('File', 'Save scene');
  const saved = await before;
  check(/\.ray$/.test(saved.suggestedFilename()), 'the scene is saved in the downloads as ' + saved.suggestedFilename());
  check(readFileSync(await saved.path(), 'utf8').includes('camera'), 'it holds a scene');

  // A link holds the scene and the pixel.
  await choose('File', 'Copy link');
  await page.waitForTimeout(1500);
  const link = page.url();
  check(/#text=[\w-]+&width=300&pixel=\d+,\d+$/.test(link), 'the link holds text, options and pixel: ' + link.slice(0, 60) + '... (' + link.length + ' characters)');
  await page.goto('about:blank');
  await page.goto(link);
  await until(/^file link\.ray$/m, 'the link opens');
  const [, linkX, linkY] = link.match(/pixel=(\d+),(\d+)$/);
  await until(new RegExp(`^pixel ${linkX} ${linkY}$`, 'm'), 'and its pixel is chosen');
  await until(/^why \S/m, 'and explained');
  await shot('link');

  // A file of the computer.
  await page.goto('about:blank');
  await page.goto(address);
  await until(/^at .* menu File$/m, 'the page loads again');
  const scene = path.join(mkdtempSync(path.join(tmpdir(), 'trace-scene-')), 'mine.ray');
  writeFileSync(scene, 'Trace 1\nsphere { material = { diffuse = (1, 0, 0) } }\n');
  await page.setInputFiles('#files', scene);
  await until(/^file mine\.ray$/m, 'a file of the computer opens');
  await until(/^logged rendered/m, 'and is rendered', 120);
  await shot('own');
  check(outside.length === 0, 'nothing is asked of another server' + outside.slice(0, 3).join(' '));
} catch (error) {
  console.log(String(error));
  ++failures;
}
let bytes = 0;
for (const name of readdirSync(folder)) bytes += gzipSync(readFileSync(path.join(folder, name)), { level: 9 }).length;
console.log('        ' + (bytes / 1e6).toFixed(2) + ' MB compressed');
check(bytes < 8e6, 'at most 8 MB');
await context.close();
server.kill();
process.exit(failures ? 1 : 0);
