// Drives the page without threads: no headers of the server, no service worker. The picture has the bits of the page with threads.
// Usage: node threads_test.mjs PAGE-FOLDER SHOTS-FOLDER RAY, where RAY is the desktop's program
import { spawnSync } from 'node:child_process';
import { mkdtempSync } from 'node:fs';
import { tmpdir } from 'node:os';
import path from 'node:path';
import { fileURLToPath } from 'node:url';
import { check, drive } from './driver.mjs';

const ray = (...words) => spawnSync(process.argv[4], words, { encoding: 'utf8' });
const scene = fileURLToPath(new URL('../../scenes/glass.ray', import.meta.url));

await drive({ headers: false, serviceWorkers: 'block' }, async (studio) => {
  const { page } = studio;
  const first = Date.now();
  await studio.load('#scene=glass.ray&width=200');
  await studio.until(/^logged rendered/m, 'a scene is rendered without threads');
  console.log('        after ' + (Date.now() - first) + ' ms');
  check(!await page.evaluate(() => crossOriginIsolated), 'the page is not isolated');
  const [x, y] = await studio.place('picture');
  await page.mouse.click(x + 20, y + 30, { delay: 60 });
  await studio.until(/^why \S/m, 'a pixel is explained');
  await studio.wait(1000);
  await studio.shot('without-threads');

  const download = page.waitForEvent('download', { timeout: 30000 });
  await studio.choose('File', 'Export picture...');
  await studio.wait(1000);
  await page.keyboard.press('Enter');
  const temporary = mkdtempSync(path.join(tmpdir(), 'trace-picture-'));
  const [ours, desktop] = ['page.png', 'desktop.png'].map((name) => path.join(temporary, name));
  await (await download).saveAs(ours);
  ray(scene, '-w', '200', '-o', desktop);
  const difference = ray('diff', ours, desktop).stdout;
  check(/identical/.test(difference), 'the picture is that of the desktop: ' + difference.split('\n')[0]);

  // A long render leaves the page alive.
  await studio.load('#scene=glass.ray&width=800&spp=256');
  await studio.until(/^at .* menu File$/m, 'a long render begins');
  await studio.wait(5000);
  const before = await studio.value('frames');
  await studio.click('menu View');
  await studio.until(/^popup open$/m, 'a menu opens meanwhile');
  await studio.wait(2000);
  check(await studio.value('frames') > before + 5, 'frames are drawn');
  check(!/^logged rendered/m.test(await studio.state()), 'and it still renders');
  await page.keyboard.press('Escape');
  await studio.load('');
  await studio.until(/^at .* start /m, 'the page of scenes');
  await studio.wait(8000);
  await studio.shot('without-threads-start');
});
