// What the tests of the page share: a server, a browser, and hands for the studio. playwright-core is found from the working
// folder.
import { spawn } from 'node:child_process';
import { createRequire } from 'node:module';
import { mkdirSync } from 'node:fs';
import path from 'node:path';

const { chromium } = createRequire(path.join(process.cwd(), 'x.js'))('playwright-core');
const here = path.dirname(new URL(import.meta.url).pathname);
export const [folder, shots] = process.argv.slice(2);
mkdirSync(shots, { recursive: true });

let failures = 0;
export function check(holds, what) {
  console.log((holds ? 'ok      ' : 'FAILED  ') + what);
  if (!holds) ++failures;
}

/// Serves the folder on a port that is free: with the headers that threads need, or plainly.
async function serve(withHeaders) {
  const server = withHeaders
    ? spawn('python3', [path.join(here, '../../web/serve.py'), folder, '0'])
    : spawn('python3', ['-u', '-m', 'http.server', '0', '-b', '127.0.0.1', '-d', folder]);
  const said = await new Promise((found) => server.stdout.on('data', (text) => found(String(text))));
  return { server, address: withHeaders ? said.trim() : 'http://localhost:' + said.match(/port (\d+)/)[1] + '/' };
}

/// Runs steps with a page in Chromium, and ends the process with 1 if a check failed.
export async function drive(options, steps) {
  const { headers = true, ...ofContext } = options;
  const { server, address } = await serve(headers);
  const browser = await chromium.launch({
    executablePath: '/usr/bin/chromium', headless: true,
    args: ['--no-sandbox', '--disable-quic', '--no-first-run', '--disable-background-networking', '--disable-component-update',
           '--disable-sync', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader'],
  });
  const context = await browser.newContext({ viewport: { width: 1280, height: 800 }, acceptDownloads: true, ...ofContext });
  await context.grantPermissions(['clipboard-read', 'clipboard-write']);
  const page = await context.newPage();
  page.on('pageerror', (error) => check(false, 'no error in the page: ' + error.message));
  const outside = [];
  page.on('request', (request) => { if (!/^(http:\/\/localhost|data:|blob:)/.test(request.url())) outside.push(request.url()); });
  const studio = new Studio(page, address, ofContext.deviceScaleFactor ?? 1);
  try {
    await steps(studio);
    check(outside.length === 0, 'nothing is asked of another server ' + outside.slice(0, 3).join(' '));
  } catch (error) {
    console.log(String(error));
    await studio.shot('failed').catch(() => {});
    console.log(await studio.state().catch(String));
    ++failures;
  }
  await browser.close();
  server.kill();
  process.exit(failures ? 1 : 0);
}

class Studio {
  constructor(page, address, scale) {
    Object.assign(this, { page, address, scale });
  }

  /// Loads the page anew with that address.
  async load(hash) {
    await this.page.goto('about:blank');
    await this.page.goto(this.address + hash);
  }
  state() { return this.page.evaluate(() => Module.ready ? Module.ccall('traceState', 'string', [], []) : ''); }
  /// The state, as soon as it matches.
  async until(pattern, what, seconds = 60) {
    for (const end = Date.now() + seconds * 1000; Date.now() < end;) {
      const text = await this.state().catch(() => '');
      if (pattern.test(text)) { check(true, what); return text; }
      await this.page.waitForTimeout(100);
    }
    check(false, what);
    throw new Error(what);
  }
  async value(name) { return Number((await this.state()).match(new RegExp('^' + name + ' (-?[\\d.]+)', 'm'))?.[1]); }
  /// The middle of what the state names, in pixels of the page.
  async place(name) {
    const escaped = name.replace(/[.*+?^${}()|[\]\\]/g, '\\$&');
    const text = await this.until(new RegExp('^at -?\\d+ -?\\d+ ' + escaped + '$', 'm'), 'there is "' + name + '"', 20);
    return this.placeIn(text, name);
  }
  placeIn(text, name) {
    const line = text.split('\n').find((each) => each.startsWith('at ') && each.split(' ').slice(3).join(' ') === name);
    return line?.split(' ').slice(1, 3).map((each) => Number(each) / this.scale);
  }
  async click(name) { await this.page.mouse.click(...await this.place(name), { delay: 60 }); }
  /// An entry of a menu.
  async choose(menu, entry) {
    await this.click('menu ' + menu);
    await this.page.waitForTimeout(400);
    await this.click('action ' + entry);
  }
  shot(name) { return this.page.screenshot({ path: path.join(shots, name + '.png') }); }
  wait(milliseconds) { return this.page.waitForTimeout(milliseconds); }
}
