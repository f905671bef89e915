// The page around the studio: loads it, hands it files of the person's computer, and saves what it writes.
// The part of the address after # says what is opened:
//   #scene=glass.ray&pixel=120,80&width=300    one of the scenes that come with Trace, and options of ray-studio
//   #text=BASE64URL                            the text of a scene, compressed with gzip
'use strict';

const element = (id) => document.getElementById(id);

function say(text) {
  element('said').textContent = text;
  element('said').style.opacity = 1;
  setTimeout(() => { element('said').style.opacity = 0; }, 4000);
}

function fail(text) {
  element('cover').style.display = '';
  element('why').textContent = text;
  element('progress').remove();
}

const toAddress = (bytes) => {
  let text = '';
  for (const byte of bytes) text += String.fromCharCode(byte);
  return btoa(text).replaceAll('+', '-').replaceAll('/', '_').replaceAll('=', '');
};
const fromAddress = (text) => Uint8Array.from(atob(text.replaceAll('-', '+').replaceAll('_', '/')), (c) => c.charCodeAt(0));
const through = async (stream, bytes) => new Uint8Array(await new Response(new Blob([bytes]).stream().pipeThrough(stream)).arrayBuffer());

/// What the studio asks of the page (src/studio/host_web.cpp).
const tracePage = {
  save(path, name) {
    const link = document.createElement('a');
    link.href = URL.createObjectURL(new Blob([FS.readFile(path)]));
    link.download = name;
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 60000);
    say('saved ' + name + ' in your downloads');
  },
  askForFiles() { element('files').click(); },
  async copyLink(path, pixel) {
    const packed = toAddress(await through(new CompressionStream('gzip'), FS.readFile(path)));
    const options = location.hash.slice(1).split('&').filter((part) => part && !/^(scene|text|pixel)=/.test(part));
    location.hash = ['text=' + packed, ...options, ...(pixel ? ['pixel=' + pixel] : [])].join('&');
    try {
      await navigator.clipboard.writeText(location.href);
      say('the link is copied');
    } catch {
      say('the link is in the address bar');
    }
  },
};

/// Writes files to a folder of their own and opens the first scene or picture among them.
async function openFiles(list) {
  const folder = '/yours';
  FS.mkdirTree(folder);
  let first = null;
  for (const file of list) {
    const path = folder + '/' + file.name.replaceAll('/', '_');
    FS.writeFile(path, new Uint8Array(await file.arrayBuffer()));
    if (!first || /\.(ray|wrl|iv|gltf|glb|obj|ply|stl|off|out|pov)(\.gz)?$/i.test(path) && !/\.(ray|pov)$/i.test(first)) first = path;
  }
  if (first) Module.ccall('traceOpened', null, ['string'], [first]);
}

/// The words of the command line that the address asks for.
async function wordsOfAddress() {
  const words = [];
  for (const part of location.hash.slice(1).split('&').filter(Boolean)) {
    const equals = part.indexOf('=');
    const name = equals < 0 ? part : part.slice(0, equals);
    const value = equals < 0 ? '' : decodeURIComponent(part.slice(equals + 1));
    if (name === 'scene') {
      words.push('/scenes/' + value.replace(/^\/+/, ''));
    } else if (name === 'text') {
      FS.writeFile('/scenes/link.ray', await through(new DecompressionStream('gzip'), fromAddress(value)));
      words.push('/scenes/link.ray');
    } else {
      words.push('--' + name + (value ? '=' + value : ''));
    }
  }
  return words;
}

/// Threads share memory, which browsers allow to pages that are isolated from others. Where the server does not say so, a
/// service worker does (isolation.js).
async function isolate() {
  if (crossOriginIsolated) return true;
  if (!isSecureContext || !navigator.serviceWorker) return false;
  const registration = await navigator.serviceWorker.register('isolation.js');
  if (registration.active && !navigator.serviceWorker.controller || !navigator.serviceWorker.controller) {
    await navigator.serviceWorker.ready;
    location.reload();
    return new Promise(() => {});
  }
  return false;
}

function fitCanvas() {
  if (Module.ready) Module.setCanvasSize(Math.round(innerWidth * devicePixelRatio), Math.round(innerHeight * devicePixelRatio));
}

var Module = {
  canvas: element('canvas'),
  arguments: [],
  print: (text) => console.log(text),
  printErr: (text) => {
    console.warn(text);
    Module.lastError = text;
  },
  setStatus(text) {
    const parts = /\((\d+(?:\.\d+)?)\/(\d+)\)/.exec(text);
    if (parts) element('progress').value = parts[1] / parts[2];
  },
  preRun: [() => {
    Module.addRunDependency('address');
    wordsOfAddress()
      .then((words) => { Module.arguments.push(...words); }, () => say('the link is damaged'))
      .finally(() => Module.removeRunDependency('address'));
  }],
  onRuntimeInitialized() { Module.ready = true; },
  postRun: [() => {
    element('cover').style.display = 'none';
    fitCanvas();
    element('canvas').focus();
  }],
  onAbort: (what) => fail('Trace stopped: ' + (what || Module.lastError || 'out of memory') + '. Reload the page to begin anew.'),
};

addEventListener('resize', fitCanvas);
addEventListener('hashchange', () => { if (!location.hash.startsWith('#text=') || !Module.ready) location.reload(); });
element('files').addEventListener('change', async (event) => {
  await openFiles(event.target.files);
  event.target.value = '';
});
element('canvas').addEventListener('contextmenu', (event) => event.preventDefault());
addEventListener('dragover', (event) => event.preventDefault());
addEventListener('drop', (event) => {
  event.preventDefault();
  event.stopImmediatePropagation();
  openFiles(event.dataTransfer.files);
}, true);

isolate().then((may) => {
  if (!may) return fail('This page needs threads. Serve it with "./dev web --serve", or over https or from localhost.');
  if (!document.createElement('canvas').getContext('webgl2')) return fail('This browser has no WebGL 2.');
  const script = document.createElement('script');
  script.src = 'ray-studio.js';
  script.onerror = () => fail('ray-studio.js is missing beside this page.');
  document.body.append(script);
});
