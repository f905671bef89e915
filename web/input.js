// Touches, text of the screen's keyboard and the clipboard, for the studio. GLFW's port knows the mouse and keys.
'use strict';

const call = (name, types, values) => { if (Module.ready) Module.ccall(name, null, types, values); };

/// Copies by the browser's clipboard, or by a field of the page where it has none for this address.
async function copyText(text) {
  if (navigator.clipboard) return navigator.clipboard.writeText(text);
  const field = document.createElement('textarea');
  field.value = text;
  document.body.append(field);
  field.select();
  const copied = document.execCommand('copy');
  field.remove();
  document.getElementById('canvas').focus();
  if (!copied) throw new Error('not copied');
}

addEventListener('paste', (event) => call('tracePasted', ['string'], [event.clipboardData.getData('text')]), true);

// Keys that mean something to the studio, and something else to browsers.
addEventListener('keydown', (event) => {
  const command = event.ctrlKey || event.metaKey;
  if (command && /^[adelosyz=+-]$/i.test(event.key) || /^F([1-4]|10)$/.test(event.key) || event.altKey && /^[a-z0-9]$/i.test(event.key))
    event.preventDefault();
}, true);

// --- Touches: the studio makes a mouse of them (src/app/input/fingers.h) -------------------------------------------

const touched = { start: 0, move: 1, end: 2, cancel: 3 };  // Touch::Kind
let byTouch = false;                                       // what was pointed with last

function passTouches(event) {
  event.preventDefault();  // and no mouse is made of it
  event.stopImmediatePropagation();
  byTouch = true;
  const kind = touched[event.type.slice('touch'.length)];
  for (const touch of event.changedTouches)
    call('traceTouched', ['number', 'number', 'number', 'number'],
         [kind, touch.identifier, touch.clientX * devicePixelRatio, touch.clientY * devicePixelRatio]);
  if (kind === touched.end) call('traceFrames', ['number'], [3]);
}
for (const type of Object.keys(touched))
  addEventListener('touch' + type, (event) => { if (event.target.id === 'canvas') passTouches(event); }, { capture: true, passive: false });
addEventListener('mousedown', () => { byTouch = false; }, true);
document.getElementById('canvas').addEventListener('contextmenu', (event) => event.preventDefault());

// --- The keyboard of the screen: it writes into a field that nobody sees, and the studio gets what changes there ----------

const typing = document.getElementById('typing');
const filling = ' '.repeat(64);  // so that there is something to delete
let typed = filling;

function showKeyboard(wanted) {
  if (wanted && byTouch) {
    typing.value = typed = filling;
    typing.focus({ preventScroll: true });
    typing.setSelectionRange(filling.length, filling.length);
  } else if (document.activeElement === typing) {
    typing.blur();
    document.getElementById('canvas').focus({ preventScroll: true });
  }
}

// GLFW's codes of keys that write nothing.
const keys = { Escape: 256, Enter: 257, Tab: 258, Backspace: 259, Delete: 261, ArrowRight: 262, ArrowLeft: 263, ArrowDown: 264, ArrowUp: 265 };
const press = (key) => call('traceKey', ['number'], [keys[key]]);

typing.addEventListener('input', () => {
  const now = typing.value;
  let same = 0;
  while (same < now.length && same < typed.length && now[same] === typed[same]) ++same;
  for (let gone = Array.from(typed.slice(same)).length; gone > 0; --gone) press('Backspace');
  for (const character of now.slice(same)) call('traceCharacter', ['number'], [character.codePointAt(0)]);
  typed = now;
  if (now.length < filling.length / 2) typing.value = typed = filling;
});
for (const type of ['keydown', 'keypress', 'keyup'])
  addEventListener(type, (event) => {
    if (event.target !== typing || event.ctrlKey || event.metaKey) return;
    event.stopImmediatePropagation();  // GLFW would write it a second time
    if (type !== 'keydown' || !(event.key in keys) || event.key === 'Backspace') return;
    event.preventDefault();
    press(event.key);
  }, true);
