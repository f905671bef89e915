// Search without a server. A page that was opened from a folder may not fetch files and may not start a worker; it
// may load scripts. So the index is a script, and from a folder a hidden frame does the work of the worker.
var __search = (() => {
  const base = new URL("..", document.currentScript.src);
  return {
    index: new Promise((resolve) => {
      window.traceSearchIndex = resolve;  // search_index.js calls it
      const script = document.createElement("script");
      script.src = new URL("search/search_index.js", base);
      script.async = true;
      document.head.append(script);
    }),
  };
})();

if (location.protocol === "file:")
  window.Worker = class extends EventTarget {
    constructor(url) {
      super();
      const frame = document.createElement("iframe");
      frame.hidden = true;
      frame.srcdoc = "<!doctype html>";
      this.ready = new Promise((resolve) => {
        frame.onload = () => {
          const inside = frame.contentWindow;
          inside.postMessage = (data) => this.dispatchEvent(new MessageEvent("message", { data }));
          inside.importScripts = (...urls) => Promise.all(urls.map((each) => this.run(inside, each)));
          this.run(inside, url).then(() => resolve(inside));
        };
      });
      document.body.append(frame);
    }
    run(inside, url) {
      return new Promise((resolve) => {
        const script = inside.document.createElement("script");
        script.src = new URL(url, location);
        script.onload = resolve;
        inside.document.body.append(script);
      });
    }
    postMessage(data) {
      this.ready.then((inside) => inside.dispatchEvent(new inside.MessageEvent("message", { data })));
    }
  };
