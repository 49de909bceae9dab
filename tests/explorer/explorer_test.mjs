// The explorer in a real browser, against the program on the command line:
//   node explorer_test.mjs PROGRAM CHROMEDRIVER CHROMIUM
// Ends with 77, skipped, where the page was not built.
import assert from "node:assert/strict";
import {execFileSync, spawnSync} from "node:child_process";
import {existsSync, mkdtempSync, readFileSync, readdirSync, statSync} from "node:fs";
import {tmpdir} from "node:os";
import {join} from "node:path";
import {pathToFileURL} from "node:url";
import {Browser} from "./browser.mjs";

const [program, driver, chromium] = process.argv.slice(2);
const folder = mkdtempSync(join(tmpdir(), "holdfast-explorer-"));
const page = join(folder, "explorer.html");
const made = spawnSync(program, ["explore", "--output", page], {encoding: "utf8"});
if (made.status === 1 && made.stderr.includes("was not built")) {
  console.log(`skipped: ${made.stderr.trim()}`);
  process.exit(77);
}
assert.equal(made.status, 0, made.stderr);

const native = (job, words, settings) => execFileSync(program,
  [job, ...words, ...settings.flatMap(([key, value]) => ["--set", `${key}=${value}`])],
  {encoding: "utf8", maxBuffer: 1 << 28, stdio: ["ignore", "pipe", "ignore"]});
const cellsOf = (text) => text.trimEnd().split("\n").map((line) => line.split(","));

/// Numbers that stand in the same place of two tables differ by 1e-9 of the largest of their column
/// at most, words not at all.
function assertSameTable(page, program, what) {
  const a = cellsOf(page), b = cellsOf(program);
  assert.equal(a.length, b.length, `${what}: rows`);
  const largest = b[0].map((_, k) => Math.max(...b.slice(1).map((row) => Math.abs(Number(row[k])))
    .filter(Number.isFinite), 0));
  b.forEach((row, i) => row.forEach((cell, k) => {
    const [here, there] = [Number(a[i][k]), Number(cell)];
    if (!Number.isFinite(there)) return assert.equal(a[i][k], cell, `${what}, row ${i}`);
    return assert.ok(Math.abs(here - there) <= 1e-9 * largest[k], `${what}, row ${i}, column ${b[0][k]}: ${a[i][k]} for ${cell}`);
  }));
}

// A generator with a fixed seed (xorshift).
let seed = 20261126;
function random(low = 0, high = 1) {
  seed ^= seed << 13; seed ^= seed >>> 17; seed ^= seed << 5;
  return low + (high - low) * ((seed >>> 0) / 4294967296);
}

function randomSettings() {
  const period = 0.0005 * 20 ** random();
  const settings = {
    "control.proportional_gain": random(-1500, 0), "control.differential_gain": random(-30, 5),
    "control.sampling_period": period, "control.processing_delay": random(0, 1) * period,
    "backlash.width": random(0, 0.001), "excitation.frequency": random(3, 20),
    "excitation.amplitude": random(0.1, 1),
  };
  const models = ["two_masses", "two_masses", "two_masses", "string", "cable"];
  const model = models[Math.floor(random(0, models.length))];
  const further = model === "two_masses" ? []
    : [["absorber.clamp_mass", String(random(0, 0.02))], ["plant.model", model], ["plant.modes", "12"]];
  return [...Object.entries(settings).map(([key, value]) => [key, String(Number(value.toPrecision(8)))]), ...further];
}

/// A job in the page: what it gives on standard output elsewhere.
const inPage = (browser, words, settings) => browser.run(
  `(words, settings) => explorer.quick.ask("test", {call: "job", words, settings})`, words, settings);

const settled = (browser) => browser.run(`async () => {
  for (let k = 0; k < 600; ++k) {
    const busy = [explorer.quick, explorer.thorough].some((one) => one.running || one.waiting.size > 0 || !one.ready);
    if (!busy && k > 5 && !document.querySelector(".waiting")) return true;
    await new Promise((resolve) => setTimeout(resolve, 50));
  }
  return false;
}`);

/// What the figures show, as text.
const shown = (browser) => browser.run(`() => ({
  cells: explorer.chart.last ? explorer.chart.last.cells.reduce((sum, cell, k) => (sum * 31 + cell * (k % 97)) % 1000003, 7) : 0,
  motion: explorer.history.csv, amplitudes: explorer.amplitudes.csv,
  verdict: document.getElementById("verdict").textContent,
  command: document.getElementById("command").textContent, address: location.hash,
})`);

const typeInto = (browser, key, text) => browser.run(`(key, text) => {
  const input = document.getElementById(key);
  input.focus();
  input.value = text;
  input.dispatchEvent(new Event(input.tagName === "SELECT" ? "change" : "input", {bubbles: true}));
}`, key, text);

const reset = async (browser) => {
  await browser.run(`() => document.getElementById("reset").click()`);
  assert.ok(await settled(browser));
};

const tests = {
  async "opens from a file, without a message and without a request"(browser) {
    assert.ok(await settled(browser));
    const sixAnswers = await browser.run(`() => document.querySelectorAll("#answers dd").length`);
    assert.equal(sixAnswers, 6);
    assert.deepEqual(await browser.log("browser"), []);
    const requests = (await browser.log("performance")).map((entry) => JSON.parse(entry.message).message)
      .filter((message) => message.method === "Network.requestWillBeSent").map((message) => message.params.request.url)
      .filter((url) => !url.startsWith("file:") && !url.startsWith("blob:") && !url.startsWith("data:"));
    assert.deepEqual(requests, []);
  },

  async "each control changes what it should and nothing else"(browser) {
    const changes = {
      "control.proportional_gain": ["-500", ["motion", "amplitudes"], ["cells"]],
      "control.differential_gain": ["-10", ["motion", "amplitudes"], ["cells"]],
      "control.sampling_period": ["4", ["motion", "amplitudes", "cells"], []],
      "control.processing_delay": ["0.9", ["motion", "amplitudes", "cells"], []],
      "backlash.width": ["0.1", ["motion"], ["cells", "amplitudes"]],
      "absorber.clamp_mass": ["8", ["amplitudes"], ["cells", "motion"]],
      "excitation.frequency": ["7", ["motion"], ["cells", "amplitudes"]],
      "excitation.amplitude": ["1", ["motion", "amplitudes"], ["cells"]],
      "plant.model": ["cable", ["cells", "motion"], []],
    };
    const before = await shown(browser);
    for (const [key, [text, changed, kept]] of Object.entries(changes)) {
      await typeInto(browser, key, text);
      assert.ok(await settled(browser), key);
      const after = await shown(browser);
      for (const part of [...changed, "command", "address"]) assert.notEqual(after[part], before[part], `${key}: ${part}`);
      for (const part of kept) assert.equal(after[part], before[part], `${key}: ${part}`);
      await reset(browser);
      assert.deepEqual(await shown(browser), before, `${key}, reset`);
    }
  },

  async "a slider and an arrow key on the point move what they say"(browser) {
    await browser.run(`() => {
      const slider = document.querySelector('[aria-label^="Differential gain"]');
      slider.value = 500;
      slider.dispatchEvent(new Event("input", {bubbles: true}));
    }`);
    const slid = await browser.run(`() => explorer.state.number("control.differential_gain")`);
    assert.ok(Math.abs(slid + 13) < 0.1, `${slid}`);
    const moved = await browser.run(`() => {
      const handle = document.querySelector("#chart .handle");
      handle.dispatchEvent(new KeyboardEvent("keydown", {key: "ArrowUp", bubbles: true}));
      handle.dispatchEvent(new KeyboardEvent("keydown", {key: "ArrowRight", bubbles: true}));
      return [explorer.state.number("control.proportional_gain"), explorer.state.number("control.differential_gain")];
    }`);
    assert.ok(moved[0] > -557 && moved[1] > slid, `${moved}`);
  },

  async "numbers are those of the command line for 50 random settings"(browser) {
    for (let k = 0; k < 50; ++k) {
      const settings = randomSettings();
      const what = settings.map(([key, value]) => `${key}=${value}`).join(" ");
      for (const words of [["simulate", "--duration", "0.3"], ["boundary", "--p=-1000:200"],
        ["stability", "--p=-1000:200:20", "--d=-40:20:20"]]) {
        const answer = await inPage(browser, words, settings);
        assert.equal(answer.code, 0, answer.notes.join(" "));
        assertSameTable(answer.text, native(words[0], words.slice(1), settings), `${words[0]} ${what}`);
      }
      const cells = await browser.run(`async (settings) => Array.from((await explorer.quick.ask("test",
        {call: "cells", settings, count: 20, p: [-1000, 200], d: [-40, 20]})).cells)`, settings);
      const stable = cellsOf(native("stability", ["--p=-1000:200:20", "--d=-40:20:20"], settings)).slice(1).map((row) => Number(row[2]));
      assert.deepEqual(cells, stable, what);
      await assertAmplitudes(browser, settings);
    }
  },

  async "an exported case gives the same answers"(browser) {
    await typeInto(browser, "control.differential_gain", "-9.5");
    await typeInto(browser, "backlash.width", "0.3");
    assert.ok(await settled(browser));
    await browser.run(`() => document.getElementById("save-case").click()`);
    const file = join(browser.downloads, "case.toml");
    for (let k = 0; k < 100 && !existsSync(file); ++k) await new Promise((resolve) => setTimeout(resolve, 50));
    const answers = execFileSync(program, ["answers", "--case", file], {encoding: "utf8"});
    const inWords = await browser.run(`() => [...document.querySelectorAll("#answers dd")].map((one) => one.textContent)`);
    for (const words of inWords) assert.ok(answers.includes(words), `${words} not in ${answers}`);
    assert.equal(inWords.length, 6);
  },

  async "the address holds the state"(browser) {
    await typeInto(browser, "control.sampling_period", "5");
    assert.ok(await settled(browser));
    const address = await browser.run(`() => location.href`);
    assert.ok(address.endsWith("#control.sampling_period=5e-3"), address);
    await browser.go("about:blank");
    await browser.go(address);
    await browser.run(`async () => { while (!globalThis.explorer?.chart?.last) await new Promise((resolve) => setTimeout(resolve, 20)); }`);
    assert.equal(await browser.run(`() => document.getElementById("control.sampling_period").value`), "5");
  },

  async "hostile settings are refused in words and the page lives"(browser) {
    const hostile = ["NaN", "1e308", "-1", "", "<script>alert(1)</script>", "inf", "-1e308", "1e-320", "\"", "0x10", "1 2"];
    const keys = await browser.run(`() => explorer.fields.filter((field) => !field.setting.choices).map((field) => field.setting.key)`);
    for (const key of keys) for (const text of hostile) {
      await typeInto(browser, key, text);
      const answer = await browser.run(`() => explorer.quick.ask("test", {call: "job", words: ["margins"], settings: explorer.state.list()})`);
      assert.notEqual(answer.code, undefined);
      const words = await browser.run(`async (key) => {
        for (let k = 0; k < 100 && (explorer.quick.running || explorer.quick.waiting.size > 0); ++k)
          await new Promise((resolve) => setTimeout(resolve, 50));
        return document.getElementById(key + "-hint").textContent + document.getElementById("refusal").textContent;
      }`, key);
      if (["NaN", "", "<script>alert(1)</script>", "\"", "1 2"].includes(text) || (text === "-1" && !key.includes("gain")))
        assert.ok(words.length > 10, `${key}=${text}: "${words}"`);
      await browser.run(`() => document.getElementById("reset").click()`);
    }
    assert.ok(await settled(browser));
    assert.match(await browser.run(`() => document.getElementById("verdict").textContent`), /^periodic\(100\)/);
    assert.deepEqual(await browser.log("browser"), []);
  },

  async "the files are small"() {
    assert.ok(statSync(page).size <= 4 << 20, `${statSync(page).size} bytes`);
  },
};

/// The amplitudes of the page at three frequencies are those of the job `response`.
async function assertAmplitudes(browser, settings) {
  const {code, rows} = await browser.run(`async (settings) => {
    const answer = await explorer.quick.ask("test", {call: "amplitudes", settings, from: 4, to: 20, count: 3});
    return {code: answer.code, rows: Array.from(answer.rows)};
  }`, settings);
  assert.equal(code, 0);
  const of = Object.fromEntries(settings);
  const [p, d] = [of["control.proportional_gain"], of["control.differential_gain"]];
  for (let k = 0; k < 3; ++k) {
    if (2 * rows[3 * k] * Number(of["control.sampling_period"]) >= 1) continue;
    const table = native("response", [`--p=${p}:${p}:1`, `--d=${d}:${d}:1`],
      [...settings, ["excitation.frequency", String(rows[3 * k])]]);
    const amplitude = Number(cellsOf(table)[1][cellsOf(table)[0].indexOf("amplitude_m")]);
    const here = rows[3 * k + 1] === null ? NaN : rows[3 * k + 1];
    assert.ok(Object.is(here, amplitude) || Math.abs(here - amplitude) <= 1e-9 * amplitude, `${here} for ${amplitude}: ${table}`);
  }
}

const browser = await Browser.open({driver, chromium});
let failures = 0;
try {
  await browser.go("about:blank");
  await browser.log("performance");
  await browser.go(pathToFileURL(page).href);
  await browser.run(`async () => { while (!globalThis.explorer?.chart?.last) await new Promise((resolve) => setTimeout(resolve, 20)); }`);
  for (const [name, test] of Object.entries(tests)) {
    try {
      if (browser.opened) await reset(browser);
      browser.opened = true;
      await test(browser);
      console.log(`ok: ${name}`);
    } catch (fault) {
      ++failures;
      console.log(`FAILED: ${name}\n${fault.stack}`);
    }
  }
} finally {
  await browser.close();
}
process.exit(failures === 0 ? 0 : 1);
