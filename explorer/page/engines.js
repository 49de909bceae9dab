// Workers with the program in them.

const textOf = (id) => document.getElementById(id).textContent;

async function compiledModule() {
  const packed = Uint8Array.from(atob(textOf("engine-binary").trim()), (letter) => letter.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"));
  return WebAssembly.compile(await new Response(stream).arrayBuffer());
}

/// A worker that does the newest request of each kind: one that waits is dropped when another of
/// its kind comes, and one that takes long is given up with its worker, by abandon() or when another
/// has come meanwhile.
class Engine {
  constructor(module, caseText) {
    this.module = module;
    this.caseText = caseText;
    this.source = URL.createObjectURL(
      new Blob([textOf("engine-text"), "\n", textOf("worker-text")], {type: "text/javascript"}));
    this.waiting = new Map();
    this.launch();
  }

  launch() {
    this.running = null;
    this.ready = false;
    this.worker = new Worker(this.source);
    this.worker.onmessage = ({data}) => this.received(data);
    this.worker.postMessage({module: this.module, caseText: this.caseText});
  }

  /// What the program gives; null where a newer request of the kind has taken its place.
  ask(kind, request) {
    return new Promise((resolve) => {
      this.waiting.get(kind)?.resolve(null);
      this.waiting.delete(kind);
      this.waiting.set(kind, {request, resolve});
      if (this.running && performance.now() - this.running.since > Engine.patience) this.giveUp();
      this.next();
    });
  }

  received(answer) {
    if (answer.ready) {
      this.ready = true;
    } else if (this.running && answer.id === this.running.id) {
      const {resolve} = this.running;
      this.running = null;
      if (answer.fatal) this.restart();
      resolve(answer);
    }
    this.next();
  }

  next() {
    if (!this.ready || this.running || this.waiting.size === 0) return;
    const [kind, {request, resolve}] = this.waiting.entries().next().value;
    this.waiting.delete(kind);
    this.running = {id: Engine.number++, resolve, since: performance.now()};
    this.worker.postMessage({id: this.running.id, ...request});
  }

  giveUp() {
    this.running.resolve(null);
    this.restart();
  }

  dropWaiting() {
    for (const {resolve} of this.waiting.values()) resolve(null);
    this.waiting.clear();
  }

  /// Gives up what it does and what waits.
  abandon() {
    this.dropWaiting();
    if (this.running) this.giveUp();
  }

  restart() {
    this.worker.terminate();
    this.launch();
  }

  /// Another case for all that follows.
  reload(caseText) {
    this.caseText = caseText;
    this.dropWaiting();
    this.running?.resolve(null);
    this.restart();
  }
}
Engine.number = 1;
Engine.patience = 3000; // ms
