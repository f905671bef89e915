// The page around the studio: loads it, hands it files of the person's computer, and saves what it writes. With
// input.js, which hands it touches, text and the clipboard.
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
    location.hash = ['text=' + packed, ...optionsOfAddress(), ...(pixel ? ['pixel=' + pixel] : [])].join('&');
    try {
      await copyText(location.href);
      say('the link is copied');
    } catch {
      say('the link is in the address bar');
    }
  },
  copy(text) { copyText(text).catch(() => say('this browser does not let the page copy')); },
  type: showKeyboard,
};

const yours = '/yours';  // the folder of files that were opened

/// Writes files to a folder of their own and opens the first scene or picture among them.
async function openFiles(list) {
  FS.mkdirTree(yours);
  let first = null;
  for (const file of list) {
    const path = yours + '/' + file.name.replaceAll('/', '_');
    FS.writeFile(path, new Uint8Array(await file.arrayBuffer()));
    if (!first || /\.(ray|wrl|iv|gltf|glb|obj|ply|stl|off|out|pov)(\.gz)?$/i.test(path) && !/\.(ray|pov)$/i.test(first)) first = path;
  }
  if (first) Module.ccall('traceOpened', null, ['string'], [first]);
}

const partsOfAddress = () => location.hash.slice(1).split('&').filter(Boolean);
const optionsOfAddress = () => partsOfAddress().filter((part) => !/^(scene|text|pixel)=/.test(part));

/// The words of the command line for a part of the address.
async function wordsOf(part) {
  const equals = part.indexOf('=');
  const name = equals < 0 ? part : part.slice(0, equals);
  const value = equals < 0 ? '' : decodeURIComponent(part.slice(equals + 1));
  if (name === 'scene') return '/scenes/' + value.replace(/^\/+/, '');
  if (name !== 'text') return '--' + name + (value ? '=' + value : '');
  FS.writeFile('/scenes/link.ray', await through(new DecompressionStream('gzip'), fromAddress(value)));
  return '/scenes/link.ray';
}

/// A page that is loaded again shows the scene as it was, with the files that it needs. They are kept with the tab, which
/// holds some megabytes: if the files do not fit, the scene is kept alone.
const kept = {
  key: 'trace scene',
  files: {},  // to be written before the program starts, after the scenes that come with it
  keep() {
    sessionStorage.removeItem(this.key);
    const [text, name, pixel] = Module.ready ? Module.ccall('traceKept', 'string', [], []).split('\n') : [''];
    if (!text) return;
    const others = FS.analyzePath(yours).exists ? FS.readdir(yours).map((each) => yours + '/' + each) : [];
    for (const names of [others.filter((each) => FS.isFile(FS.stat(each).mode)), []]) {
      const files = Object.fromEntries(names.map((each) => [each, toAddress(FS.readFile(each))]));
      files[name] = toAddress(FS.readFile(text));
      try {
        return sessionStorage.setItem(this.key, JSON.stringify({ address: location.hash, name, pixel, files }));
      } catch { /* does not fit */ }
    }
  },
  /// The words of the command line; null if nothing was kept.
  words() {
    const text = sessionStorage.getItem(this.key);
    sessionStorage.removeItem(this.key);
    const { address, name, pixel, files } = text ? JSON.parse(text) : {};
    if (!text || address !== location.hash || performance.getEntriesByType('navigation')[0]?.type !== 'reload') return null;
    this.files = files;
    return [name, ...(pixel ? ['--pixel=' + pixel] : [])];
  },
  writeFiles() {
    for (const [path, bytes] of Object.entries(this.files)) {
      FS.mkdirTree(path.slice(0, path.lastIndexOf('/')) || '/');
      FS.writeFile(path, fromAddress(bytes));
    }
  },
};

async function wordsToStart() {
  const options = kept.words();
  return options ? [...options, ...await Promise.all(optionsOfAddress().map(wordsOf))] : Promise.all(partsOfAddress().map(wordsOf));
}

/// Threads share memory, which browsers allow to pages that are isolated from others. Where the server does not say so, a
/// service worker does (isolation.js), if the browser lets it. False if there are no threads then.
async function isolate() {
  if (crossOriginIsolated) return true;
  if (!isSecureContext || !navigator.serviceWorker) return false;
  try {
    await navigator.serviceWorker.register('isolation.js');
    if (navigator.serviceWorker.controller) return false;  // it serves the page already, and that was not enough
    const ready = await Promise.race([navigator.serviceWorker.ready, new Promise((late) => setTimeout(late, 3000))]);
    if (!ready) return false;
  } catch {
    return false;
  }
  location.reload();
  return new Promise(() => {});
}

/// Without threads: the program has the instructions that threads need, and they work with memory that is not shared, too. The
/// format of programs (WebAssembly) says in a byte of the imported memory whether it is shared.
async function loadWithoutThreads() {
  const bytes = new Uint8Array(await (await fetch('ray-studio.wasm')).arrayBuffer());
  const most = 65536;  // pages of 64 KB
  markUnshared(bytes, most);
  Module.wasmMemory = new WebAssembly.Memory({ initial: 4096, maximum: most });
  Module.workers = 0;
  Module.instantiateWasm = (imports, receive) => {
    WebAssembly.instantiate(bytes, imports).then(({ instance, module }) => {
      receive(instance, module);
      Module.removeRunDependency('wasm-instantiate');  // the last worker would do it
    }, (error) => fail('The program could not be loaded: ' + error.message));
    return {};
  };
  Object.defineProperty(navigator, 'hardwareConcurrency', { value: 1 });
  window.TextDecoder = undefined;  // what the program has around it asks for shared memory
}

/// Clears the flag of the first memory among the imports (section 2).
function markUnshared(bytes, most) {
  let at = 8;
  const number = () => {
    let value = 0;
    for (let shift = 0; ; shift += 7) {
      const byte = bytes[at++];
      value += (byte & 127) * 2 ** shift;
      if (byte < 128) return value;
    }
  };
  const skipName = () => { const length = number(); at += length; };
  while (at < bytes.length) {
    const section = bytes[at++], length = number(), end = at + length;
    if (section === 2) {
      for (let count = number(); count > 0; --count) {
        skipName();
        skipName();
        const kind = bytes[at++];
        if (kind === 2) {  // memory: limits
          if (bytes[at] === 3) bytes[at] = 1;  // with a maximum, and no longer shared
          return;
        }
        if (kind === 0) number();  // function: its type
        if (kind === 1) { ++at; if (bytes[at++] & 1) number(); number(); }  // table: type, limits
        if (kind === 3) at += 2;  // global
        if (kind === 4) { ++at; number(); }  // tag
      }
    }
    at = end;
  }
}

function fitCanvas() {
  const view = window.visualViewport;
  const high = view && view.scale === 1 ? Math.min(view.height, innerHeight) : innerHeight;  // above the keyboard of the screen
  document.documentElement.style.setProperty('--high', high + 'px');
  if (Module.ready) Module.setCanvasSize(Math.round(innerWidth * devicePixelRatio), Math.round(high * devicePixelRatio));
}

var Module = {
  canvas: element('canvas'),
  arguments: [],
  workers: navigator.hardwareConcurrency + 16,
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
    wordsToStart()
      .then((words) => { Module.arguments.push(...words); }, () => say('the link is damaged'))
      .finally(() => Module.removeRunDependency('address'));
  }],
  onRuntimeInitialized() {
    kept.writeFiles();
    Module.ready = true;
  },
  postRun: [() => {
    element('cover').style.display = 'none';
    fitCanvas();
    element('canvas').focus();
    if (!Module.workers) say('without threads: slower. Serve the page over https or from localhost to have them.');
  }],
  onAbort: (what) => fail('Trace stopped: ' + (what || Module.lastError || 'out of memory') + '. Reload the page to begin anew.'),
};

addEventListener('resize', fitCanvas);
window.visualViewport?.addEventListener('resize', fitCanvas);
addEventListener('pagehide', () => kept.keep());
addEventListener('hashchange', () => { if (!location.hash.startsWith('#text=') || !Module.ready) location.reload(); });
element('files').addEventListener('change', async (event) => {
  await openFiles(event.target.files);
  event.target.value = '';
});
addEventListener('dragover', (event) => event.preventDefault());
addEventListener('drop', (event) => {
  event.preventDefault();
  event.stopImmediatePropagation();
  openFiles(event.dataTransfer.files);
}, true);

async function start() {
  if (!document.createElement('canvas').getContext('webgl2')) return fail('This browser has no WebGL 2.');
  if (!await isolate()) await loadWithoutThreads();
  const script = document.createElement('script');
  script.src = 'ray-studio.js';
  script.onerror = () => fail('ray-studio.js is missing beside this page.');
  document.body.append(script);
}
start().catch((error) => fail('The page could not be loaded: ' + error.message));
