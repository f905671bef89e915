// Drives the page (./dev web) in Chromium: opens a scene, renders it, asks a pixel for its rays, edits, saves, loads again.
// Usage: node page_test.mjs PAGE-FOLDER SHOTS-FOLDER; playwright-core is found from the working folder.
import { spawn } from 'node:child_process';
import { createRequire } from 'node:module';
import { mkdtempSync, mkdirSync, readFileSync, statSync, readdirSync } from 'node:fs';
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
async function place(name) {
  const text = await until(new RegExp('^' + name.replace(/[.*+?^${}()|[\]\\]/g, '\\$&') + ' ', 'm'), 'there is "' + name + '"', 20);
  const line = text.split('\n').find((each) => each.startsWith(name + ' '));
  const [x0, y0, x1, y1] = line.slice(name.length).trim().split(/\s+/).map(Number);
  return [(x0 + x1) / 2, (y0 + y1) / 2];
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
  await until(/rendered|samples/, 'a scene named in the address is rendered');
  console.log('        first picture after ' + (Date.now() - first) + ' ms');
  await page.waitForTimeout(5000);
  await shot('scene');
  console.log(await stateText());
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
