// One module of the program in a worker: does one request after the other and posts what came of it.
let engine = null;
let complained = "";
const casePath = "/case.toml", tablePath = "/table.csv", savedPath = "/saved.toml";

const bytesInto = (take) => { // gathers a stream of the program
  const bytes = [];
  return (byte) => {
    if (byte !== null) bytes.push(byte < 0 ? byte + 256 : byte);
    if (byte === null || byte === 10) { take(new TextDecoder().decode(new Uint8Array(bytes))); bytes.length = 0; }
  };
};

async function start(module, caseText) {
  engine = await createHoldfast({
    // Tables come by a file; nothing is read, and what else is printed nobody asks for.
    preRun: [(self) => self.FS.init(() => null, () => {}, bytesInto((text) => { complained += text; }))],
    instantiateWasm(imports, receive) {
      WebAssembly.instantiate(module, imports).then((instance) => receive(instance, module));
      return {};
    },
  });
  engine.FS.writeFile(casePath, caseText);
}

function removed(path) {
  try { engine.FS.unlink(path); } catch { /* was not there */ }
}

/// What the program said on standard error, a line each, without its name before it.
function complaints() {
  return complained.split("\n").map((line) => line.replace(/^holdfast: /, "")).filter((line) => line);
}

const withSettings = (settings) => settings.flatMap(([key, value]) => ["--set", `${key}=${value}`]);

const requests = {
  job({words, settings}) {
    removed(tablePath);
    const code = engine.callMain([...words, "--output", tablePath, "--case", casePath, ...withSettings(settings)]);
    return {code, text: code === 0 ? engine.FS.readFile(tablePath, {encoding: "utf8"}) : ""};
  },
  save({settings}) {
    removed(savedPath);
    const code = engine.ccall("holdfast_save_case", "number", ["string", "string"], [lines(settings), savedPath]);
    return {code, text: code === 0 ? engine.FS.readFile(savedPath, {encoding: "utf8"}) : ""};
  },
  cells({settings, p, d, count}) {
    const place = engine._malloc(count * count);
    const code = engine.ccall("holdfast_stable_cells", "number",
      ["string", "number", "number", "number", "number", "number", "number", "number"],
      [lines(settings), p[0], p[1], count, d[0], d[1], count, place]);
    const cells = engine.HEAPU8.slice(place, place + count * count);
    engine._free(place);
    return {code, cells, count, p, d};
  },
  amplitudes({settings, from, to, count}) {
    const length = 3 * count + 1;
    const place = engine._malloc(8 * length);
    const code = engine.ccall("holdfast_amplitudes", "number",
      ["string", "number", "number", "number", "number"], [lines(settings), from, to, count, place]);
    const rows = engine.HEAPF64.slice(place / 8, place / 8 + length);
    engine._free(place);
    return {code, rows};
  },
};

const lines = (settings) => settings.map(([key, value]) => `${key}=${value}`).join("\n");

function answered(request) {
  complained = "";
  try {
    return {...requests[request.call](request), notes: complaints()};
  } catch (fault) {
    return {code: 1, fatal: true, notes: [`the program failed: ${fault}`]};
  }
}

onmessage = async ({data}) => {
  if (data.module) {
    await start(data.module, data.caseText);
    postMessage({ready: true});
  } else {
    postMessage({id: data.id, ...answered(data)});
  }
};
