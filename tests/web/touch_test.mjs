// Drives the page with fingers, on the screen of a phone.
// Usage: node touch_test.mjs PAGE-FOLDER SHOTS-FOLDER
import { check, drive } from './driver.mjs';

await drive({ viewport: { width: 390, height: 844 }, deviceScaleFactor: 3, hasTouch: true, isMobile: true }, async (studio) => {
  const { page } = studio;
  const browser = await page.context().newCDPSession(page);
  const touch = (type, points) =>
    browser.send('Input.dispatchTouchEvent', { type, touchPoints: points.map(([x, y], id) => ({ x, y, id })) });
  /// Fingers that go from the first places to the last ones, in steps.
  async function move(...places) {
    await touch('touchStart', places[0]);
    for (const points of places.slice(1)) {
      await studio.wait(80);
      await touch('touchMove', points);
    }
    await studio.wait(80);
    await touch('touchEnd', []);
    await studio.wait(500);
  }
  async function tap(name) {
    const [x, y] = await studio.place(name);
    await touch('touchStart', [[x, y]]);
    await studio.wait(60);
    await touch('touchEnd', []);
    await studio.wait(600);
  }

  await studio.load('');
  await studio.until(/^at .* start /m, 'the page of scenes');
  await studio.wait(6000);
  await studio.shot('phone-start');

  await studio.load('#scene=glass.ray&width=300');
  await studio.until(/^logged rendered/m, 'a scene is rendered');
  await studio.wait(1500);
  const [x, y] = await studio.place('picture');
  await touch('touchStart', [[x - 40, y + 10]]);
  await studio.wait(60);
  await touch('touchEnd', []);
  const pixel = (await studio.until(/^why \S/m, 'a tap chooses a pixel')).match(/^pixel (.*)$/m)[1];
  await studio.wait(1500);
  await studio.shot('phone');

  const [u, v] = await studio.place('space');
  let drawn = await studio.value('space-drawn');
  await move([[u, v]], [[u + 20, v]], [[u + 50, v + 10]]);
  check(await studio.value('space-drawn') > drawn, 'a finger turns the view in space');
  await studio.shot('phone-turned');
  drawn = await studio.value('space-drawn');
  await move([[u - 30, v], [u + 30, v]], [[u - 50, v], [u + 50, v]], [[u - 80, v], [u + 80, v]]);
  check(await studio.value('space-drawn') > drawn, 'two fingers enlarge it');
  check((await studio.state()).includes('pixel ' + pixel), 'the pixel stays');
  await studio.shot('phone-enlarged');

  const [tabX, tabY] = await studio.place('panel Rays');
  await touch('touchStart', [[tabX, tabY]]);
  await studio.until(/^popup open$/m, 'a finger that rests opens the menu of the right button');
  await touch('touchEnd', []);
  await page.keyboard.press('Escape');
  await studio.until(/^popup none$/m, 'which closes');

  await tap('menu View');
  await tap('action Build');
  await tap('panel Controls');
  await studio.until(/^at .* option spp$/m, 'all options are shown');
  const before = await studio.place('option spp');
  await move([before], [[before[0], before[1] - 20]], [[before[0], before[1] - 60]]);
  const after = studio.placeIn(await studio.state(), 'option spp');
  check(!after || after[1] < before[1] - 20, 'a finger scrolls a list');
  await studio.shot('phone-options');

  await tap('find an option');
  check(await page.evaluate(() => document.activeElement.id) === 'typing', 'the keyboard of the screen is asked for');
  await page.keyboard.insertText('depth');
  await studio.until(/^at .* option depth$/m, 'what it writes arrives');
  check(!/ option spp$/m.test(await studio.state()), 'in the field');
  await studio.shot('phone-text');
  for (let i = 0; i < 5; ++i) await page.keyboard.press('Backspace');
  await studio.until(/ option spp$/m, 'what it deletes, too');
  await tap('menu File');
  await studio.wait(500);
  await studio.shot('phone-menu');
});
