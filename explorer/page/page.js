// The page: settings ask, engines answer, figures show.

/// The rows of a CSV text, by its header.
const rowsOf = (text) => d3.csvParse(text);
const column = (rows, name, factor = 1) => rows.map((row) => (row[name] === "" ? NaN : factor * Number(row[name])));

// Words of the job `margins`.
const outcomes = {none: "no limit", beyond_search: "none that was looked for"};
const curves = {minus_one: "root at −1", plus_one: "root at 1", complex_pair: "pair of roots"};

const caseText = "case.text", caseName = "case.name"; // in the address

/// Intervals of time in which the flag is set, a sample each at least.
function bandsOf(times, flags) {
  const bands = [];
  const pace = times.length > 1 ? times[1] - times[0] : 0;
  flags.forEach((flag, k) => {
    if (!flag) return;
    const last = bands[bands.length - 1];
    if (last && k > 0 && flags[k - 1]) last[1] = times[k] + pace;
    else bands.push([times[k], times[k] + pace]);
  });
  return bands;
}

class Explorer {
  constructor() {
    this.base = JSON.parse(textOf("case-of-page"));
    this.state = new State();
    this.fields = [];
    this.byId = (id) => document.getElementById(id);
  }

  async open() {
    const address = new URLSearchParams(location.hash.slice(1));
    if (address.has(caseText)) this.base = {name: address.get(caseName) ?? "", text: address.get(caseText), opened: true};
    this.module = await compiledModule();
    this.quick = new Engine(this.module, this.base.text);
    this.thorough = new Engine(this.module, this.base.text);
    if (!await this.readCase()) {
      this.byId("verdict").textContent = "This case cannot be computed in a browser.";
      return;
    }
    this.state.fromAddress(location.hash.slice(1));
    this.buildFields();
    this.buildFigures();
    this.wire();
    this.refresh();
  }

  /// The values of the case itself; false where it is none.
  async readCase() {
    const answer = await this.quick.ask("case", {call: "job", words: ["case"], settings: []});
    this.tellOfFile(answer.code === 0 ? "" : answer.notes.join(" "));
    if (answer.code !== 0) return false;
    const rows = rowsOf(answer.text);
    this.state.own = new Map(rows.filter((row) => settingOf(row.key))
      .map((row) => [row.key, row.value.replace(/^"(.*)"$/s, "$1")]));
    this.gains = this.ownGains = this.gainsOf(rows);
    this.windForce = {}; // of a case with wind, which has no keys for it
    for (const part of ["frequency", "amplitude"])
      if (!this.state.own.has(`excitation.${part}`))
        this.windForce[part] = Number(rows.find((row) => row.key === `force_${part}`)?.value);
    this.byId("case-name").textContent = this.base.name || "the built-in case";
    return true;
  }

  /// The gains in force by the job `case`: a P that is tuned is a number there.
  gainsOf(rows) {
    const value = (key) => Number(rows.find((row) => row.key === key)?.value);
    return [value("proportional_gain"), value(gainKeys[1])];
  }

  /// The frequency (Hz) or amplitude (N) of the force.
  force(part) { return this.windForce[part] ?? this.state.number(`excitation.${part}`); }

  /// The program's words with the name of the case for that of the file which it reads here.
  named(words) { return words.replace(/\/case\.toml(:\d+)?/g, this.base.name || "the case"); }

  tellOfFile(words) {
    const box = this.byId("file-refusal");
    box.hidden = words === "";
    box.textContent = this.named(words);
  }

  buildFields() {
    this.byId("controls").replaceChildren();
    this.fields = settings.map((setting) => new Field(setting, this.state, (key) => this.change(key)));
    this.byId("controls").append(...this.fields.map((field) => field.element));
    this.fields.forEach((field) => field.show());
  }

  buildFigures() {
    this.chart = new StabilityFigure("chart", (gains) => this.moveTo(gains), () => this.refresh());
    this.frameChart();
    this.history = new LineFigure("history", {title: "How does it move?", x: "time (s)",
      y: "conductor z₁ (mm)", name: "motion"});
    this.phase = new LineFigure("phase", {title: "Phase plane, second half of the time", x: "z₁ (mm)",
      y: "ż₁ (mm/s)", name: "phase-plane"});
    this.amplitudes = new LineFigure("amplitudes", {title: "How much vibration is left?", x: "frequency (Hz)",
      y: "amplitude left without play (%)", name: "amplitudes"});
  }

  /// About the point, as wide as the built-in case's window is about its own.
  frameChart() {
    const [p, d] = this.ownGains;
    const aboutP = sizeOf(p, 500), aboutD = sizeOf(d, 10);
    this.chart.frame([p - aboutP, p + 1.5 * aboutP], [d - 2.2 * aboutD, d + 2.2 * aboutD]);
  }

  wire() {
    const on = (id, action) => this.byId(id).addEventListener("click", action);
    on("save-case", () => this.saveCase());
    on("copy-link", () => this.copyLink());
    on("reset", () => { this.state.changed.clear(); this.frameChart(); this.showState(); this.refresh(); });
    on("theme", () => this.turnTheme());
    this.byId("load-case").addEventListener("change", (event) => {
      this.loadCase(event.target.files[0]);
      event.target.value = ""; // so that the same file may come again
    });
    this.byId("controls").addEventListener("submit", (event) => event.preventDefault());
    addEventListener("hashchange", () => {
      if (location.hash.slice(1) === this.address()) return;
      this.state.fromAddress(location.hash.slice(1));
      this.showState();
      this.refresh();
    });
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.showTheme());
    this.showTheme();
  }

  isDark() {
    const {theme} = document.documentElement.dataset;
    return theme ? theme === "dark" : matchMedia("(prefers-color-scheme: dark)").matches;
  }

  turnTheme() {
    document.documentElement.dataset.theme = this.isDark() ? "light" : "dark";
    this.showTheme();
  }

  showTheme() {
    this.byId("theme").textContent = this.isDark() ? "Light" : "Dark";
    if (this.chart.last) this.chart.drawCells(this.chart.last);
  }

  /// What stands behind the "#": the settings, and the text of a case that was opened here.
  address() {
    const own = this.base.opened ? new URLSearchParams([[caseName, this.base.name], [caseText, this.base.text]]).toString() : "";
    return [this.state.toAddress(), own].filter((part) => part).join("&");
  }

  showAddress() {
    const address = this.address();
    try {
      history.replaceState(null, "", address ? `#${address}` : location.pathname + location.search);
    } catch { /* some browsers allow so many changes in a time */ }
  }

  async copyLink() {
    this.showAddress();
    const button = this.byId("copy-link");
    try {
      await navigator.clipboard.writeText(location.href);
      button.textContent = "Copied";
    } catch {
      button.textContent = "Take it from the address bar";
    }
    setTimeout(() => { button.textContent = "Copy link"; }, 2000);
  }

  showState() { this.fields.forEach((field) => field.show()); }

  change(key) {
    this.tellOfFile("");
    if (key === modelKey) this.showState();
    this.refresh();
  }

  moveTo(gains) {
    gainKeys.forEach((key, k) => this.state.set(key, gains[k]));
    this.showState();
    this.refresh();
  }

  /// Asks for all that the state shows: what follows the hand at once, the rest when it rests.
  refresh() {
    this.askGains();
    this.askCells();
    this.askMotion();
    this.askAmplitudes();
    clearTimeout(this.resting);
    this.resting = setTimeout(() => { this.showAddress(); this.askThorough(); }, 250);
    this.thorough.abandon();
    const plane = this.plane();
    this.chart.boundary.selectAll("path").classed("old", plane !== this.planeOfBoundary);
    for (const id of ["verdict-card", "margins", "answers"]) this.byId(id).classList.add("waiting");
  }

  /// What the chart depends on beside its window.
  plane() { return this.state.signature(...gainKeys); }

  /// The point of the chart: its gains as they are written, or by the program where P is tuned.
  async askGains() {
    const tuned = this.state.text(gainKeys[0]) === "tuned";
    this.showPoint(tuned ? this.gains : gainKeys.map((key) => this.state.number(key)));
    if (!tuned) return;
    const answer = await this.quick.ask("case", {call: "job", words: ["case"], settings: this.state.list()});
    if (answer?.code === 0) this.showPoint(this.gainsOf(rowsOf(answer.text)));
  }

  showPoint(gains) {
    this.gains = gains;
    this.chart.drawPoint(gains);
    this.sayStability();
    this.showCommand();
  }

  async askCells() {
    const conductor = this.state.text(modelKey) !== "two_masses";
    const signature = this.plane() + JSON.stringify(this.chart.window());
    if (conductor && signature === this.cellsOf) { // the gains move, their plane stays
      this.chart.refused(false);
      return this.sayStability();
    }
    const answer = await this.quick.ask("cells", {call: "cells", settings: this.state.list(),
      count: conductor ? 80 : cellsAcross, ...this.chart.window()});
    if (answer === null) return undefined;
    this.judge(answer);
    this.chart.refused(answer.code !== 0);
    this.cellsOf = answer.code === 0 ? signature : null;
    if (answer.code !== 0) return undefined;
    this.chart.drawCells(answer);
    return this.sayStability();
  }

  sayStability() {
    if (!this.chart.last || this.chart.root.classed("waiting")) return;
    const cell = this.chart.cellOfPoint();
    const words = cell === undefined ? "outside the window" : cell ? "stable" : "not stable";
    this.chart.say(`The case's gains: ${words}. Shaded: stable without play; lines: where a root crosses the unit circle. ` +
      "Drag the point or click; drag beside it to move the window.");
  }

  async askMotion() {
    const answer = await this.quick.ask("motion", {call: "job",
      words: ["simulate", "--duration", String(this.duration())], settings: this.state.list()});
    if (answer === null) return;
    for (const figure of [this.history, this.phase]) figure.refused(answer.code !== 0);
    if (answer.code !== 0) return;
    this.drawMotion(answer.text);
  }

  /// Twenty periods of the force, of two thousand samples at most.
  duration() {
    const period = 1 / this.force("frequency");
    const most = 2000 * this.state.number("control.sampling_period");
    const wanted = Math.min(20 * period, most);
    return Number.isFinite(wanted) && wanted > 0 ? Number(wanted.toPrecision(6)) : 1;
  }

  drawMotion(text) {
    const rows = rowsOf(text);
    const largest = d3.max(column(rows, "z1_m"), Math.abs);
    const [unit, factor] = largest > 0 && largest < 5e-5 ? ["µm", 1e6] : ["mm", 1e3];
    const time = column(rows, "time_s"), z = column(rows, "z1_m", factor), v = column(rows, "v1_m_per_s", factor);
    this.history.label("time (s)", `conductor z₁ (${unit})`);
    this.phase.label(`z₁ (${unit})`, `ż₁ (${unit}/s)`);
    const inPlay = column(rows, "in_backlash").map((flag) => flag === 1);
    this.history.draw([{name: "conductor", style: "first", x: time, y: z},
      {name: "in the play", style: "play", x: [], y: []}], {bands: bandsOf(time, inPlay)});
    this.history.say("Shaded: the drive is in the play of its belt and exerts no force.");
    const half = time.length >> 1;
    const lines = text.trimEnd().split("\n");
    this.history.csv = text;
    this.phase.csv = [lines[0], ...lines.slice(1 + half), ""].join("\n");
    const where = (flag) => v.map((value, k) => (k >= half && (inPlay[k] === flag || inPlay[k - 1] === flag) ? value : NaN));
    const series = [{name: "force acts", style: "first", x: z, y: where(false), byPoint: true},
      {name: "in the play", style: "play", x: z, y: where(true), byPoint: true}];
    this.phase.draw(series, {x: extentOf(z.slice(half))});
    this.phase.say("The conductor's displacement and velocity at the samples.");
  }

  /// From 3 to 60 Hz, or as far as the case's own force is.
  frequencies() {
    const own = this.force("frequency");
    return own > 0 && own < 1e6 ? [Math.min(3, own / 2), Math.max(60, 1.5 * own)] : [3, 60];
  }

  async askAmplitudes() {
    const [from, to] = this.frequencies();
    const ask = (model) => this.quick.ask(`amplitudes of ${model}`, {call: "amplitudes", from, to, count: 115,
      settings: this.state.list({[modelKey]: model})});
    const beside = this.state.text(modelKey) === "two_masses" ? "cable" : this.state.text(modelKey);
    const [masses, conductor] = await Promise.all([ask("two_masses"), ask(beside)]);
    if (masses === null || conductor === null) return;
    const failed = masses.code !== 0 && conductor.code !== 0;
    this.amplitudes.refused(failed);
    this.withPlay = undefined;
    if (!failed) this.drawAmplitudes([
      {...masses, name: "two masses", style: "first"},
      {...conductor, name: settingOf(modelKey).choices[beside], style: "second dashed"}], [from, to]);
  }

  drawAmplitudes(answers, range) {
    const lists = answers.filter((one) => one.code === 0).map((one) => {
      const part = (place) => Array.from(one.rows.slice(0, -1)).filter((_, k) => k % 3 === place);
      const [x, controlled, uncontrolled] = [part(0), part(1), part(2)];
      return {...one, x, controlled, uncontrolled, y: controlled.map((value, k) => 100 * value / uncontrolled[k]),
        stable: one.rows[one.rows.length - 1] === 1};
    });
    const {x} = lists[0];
    const series = [...lists, {name: "without control", style: "third", x, y: x.map(() => 100)}];
    const largest = Math.min(300, d3.max(series.flatMap((one) => one.y), (value) => (Number.isFinite(value) ? value : 0)));
    this.shownAmplitudes = {series, range: {x: range, y: [0, 1.08 * largest]}};
    this.markAmplitudes();
    this.amplitudes.say(this.wordsOfAmplitudes(lists));
    const rows = x.map((f, k) => [f, ...lists.flatMap((one) => [one.controlled[k], one.uncontrolled[k]])].join(","));
    const heads = lists.flatMap(({name}) => [`${name}_m`, `${name}_without_control_m`]).map((one) => one.replaceAll(" ", "_"));
    this.amplitudes.csv = [["frequency_Hz", ...heads].join(","), ...rows, ""].join("\n");
  }

  wordsOfAmplitudes(lists) {
    if (this.force("amplitude") === 0) return "No force, hence no vibration.";
    const unstable = lists.filter((one) => !one.stable).map((one) => one.name);
    const seen = 0.5 / this.state.number("control.sampling_period");
    const dot = this.windForce.frequency ? "" : "; the dot: with play, at the case's frequency";
    return `Of the steady vibration without play, against that without control${dot}.` +
      (unstable.length ? ` No steady vibration without play on ${unstable.join(" and ")}: the loop is not stable there.` : "") +
      (seen < this.frequencies()[1] ? ` From ${numbers(seen)} Hz on the computer takes fewer than two samples a period.` : "");
  }

  markAmplitudes() {
    if (!this.shownAmplitudes) return;
    const {series, range} = this.shownAmplitudes;
    this.amplitudes.draw(series, {...range, mark: {x: this.force("frequency"), y: this.withPlay}});
  }

  /// What is left with play, of the case itself.
  async askLeft() {
    const frequency = this.state.text("excitation.frequency");
    const answer = await this.job("left", ["sweep", "--axis", `excitation.frequency=${frequency}`,
      "--metric", "ratio_to_uncontrolled", "--threads", "1"]);
    if (answer === null) return;
    this.withPlay = answer.code === 0 ? 100 * Number(rowsOf(answer.text)[0]?.ratio_to_uncontrolled) : undefined;
    this.markAmplitudes();
  }

  askThorough() {
    this.askBoundary();
    this.askVerdict();
    this.askLeft();
    this.askMargins();
    this.askAnswers();
  }

  async job(kind, words) {
    return this.thorough.ask(kind, {call: "job", words, settings: this.state.list()});
  }

  async askBoundary() {
    const p = this.chart.widerGains(), plane = this.plane();
    const answer = await this.job("boundary", ["boundary", `--p=${p[0]}:${p[1]}`]);
    if (answer === null) return;
    this.planeOfBoundary = plane;
    this.chart.drawBoundary(answer.code === 0 ? rowsOf(answer.text) : []);
  }

  async askVerdict() {
    const answer = await this.job("verdict", ["verdict"]);
    if (answer === null) return;
    this.judge(answer);
    this.byId("verdict-card").classList.remove("waiting");
    const row = answer.code === 0 ? rowsOf(answer.text)[0] : null;
    if (!row && answer.code !== 2) this.byId("verdict-grounds").textContent = answer.notes.join(" ");
    const period = row && Number(row.period_s) > 0 ? `, ${numbers(Number(row.period_s))} s` : "";
    this.byId("verdict").textContent = row ? row.verdict + period + (row.certified === "1" ? " — certified" : "") : "no verdict";
    this.byId("verdict-grounds").textContent = row ? row.rests_on : "";
    this.byId("notes").replaceChildren(...(answer.code === 0 ? answer.notes : []).map((note) => {
      const item = document.createElement("li");
      item.textContent = this.named(note);
      return item;
    }));
  }

  async askMargins() {
    const answer = await this.job("margins", ["margins"]);
    if (answer === null) return;
    this.byId("margins").classList.remove("waiting");
    const box = this.byId("margins").querySelector(".scrolling");
    if (answer.code !== 0) return void (box.textContent = this.wordsOfRefusal(answer));
    box.replaceChildren(this.table(["quantity", "side", "from", "to", "distance", "what happens there"],
      rowsOf(answer.text).map((row) => [`${row.quantity.replaceAll("_", " ")} (${row.unit.replace(".", " ")})`, row.side,
        numbers(Number(row.value)), row.outcome === "boundary" ? numbers(Number(row.position)) : outcomes[row.outcome] ?? row.outcome,
        row.outcome === "boundary" ? numbers(Number(row.distance)) : "",
        (curves[row.curve] ?? row.curve) + (Number(row.frequency_Hz) > 0 ? ` at ${numbers(Number(row.frequency_Hz))} Hz` : "")])));
  }

  table(heads, rows) {
    const table = document.createElement("table");
    const line = (cells, kind) => {
      const row = document.createElement("tr");
      row.append(...cells.map((text) => Object.assign(document.createElement(kind), {textContent: text})));
      return row;
    };
    const head = document.createElement("thead"), body = document.createElement("tbody");
    head.append(line(heads, "th"));
    head.querySelectorAll("th").forEach((cell) => { cell.scope = "col"; });
    body.append(...rows.map((row) => line(row, "td")));
    table.append(head, body);
    return table;
  }

  async askAnswers() {
    const list = this.byId("answers").querySelector("dl");
    const answer = await this.job("answers", ["answers"]);
    if (answer === null) return;
    this.byId("answers").classList.remove("waiting");
    if (answer.code !== 0) return void (list.textContent = this.wordsOfRefusal(answer));
    list.replaceChildren(...rowsOf(answer.text).flatMap((row) => [
      Object.assign(document.createElement("dt"), {textContent: row.question}),
      Object.assign(document.createElement("dd"), {textContent: this.named(row.answer)})]));
  }

  /// Shows what is wrong with the settings where the program says so, at the field that it names.
  judge(answer) {
    const words = answer.code === 0 ? "" : answer.notes.filter((note) => !note.startsWith("warning:")).join(" ");
    const blamed = words.match(/^--set ([\w.]+)=/)?.[1];
    const own = this.named(words.replace(/^--set [^:]*: /, ""));
    let told = false;
    for (const field of this.fields) {
      const its = own !== "" && (blamed ? blamed === field.setting.key : words.includes(field.setting.key));
      field.refuse(its ? own : "");
      told = told || (its && !field.element.hidden);
    }
    this.refuse(own && !told ? [words] : []);
  }

  /// In place of a result: what is wrong stands at its field already.
  wordsOfRefusal(answer) {
    return answer.code === 2 ? "Not computed: see the settings." : answer.notes.join(" ");
  }

  refuse(notes) {
    const box = this.byId("refusal");
    box.hidden = notes.length === 0;
    box.textContent = notes.join(" ");
  }

  showCommand() {
    const plain = /^[\w\-=.,:/+@%]+$/;
    const quoted = (word) => (plain.test(word) ? word : `'${word.replaceAll("'", "'\\''")}'`);
    const set = this.state.list().map(([key, value]) => `--set ${quoted(`${key}=${value}`)}`);
    const words = this.base.name ? [`--case ${quoted(this.base.name)}`, ...set] : set;
    const {p, d} = this.chart.window();
    const [gainP, gainD] = this.gains;
    const options = {verdict: "", margins: "", answers: "", simulate: ` --duration ${this.duration()}`,
      stability: ` --p=${p[0]}:${p[1]}:${cellsAcross} --d=${d[0]}:${d[1]}:${cellsAcross}`,
      boundary: ` --p=${p[0]}:${p[1]}`, response: ` --p=${gainP}:${gainP}:1 --d=${gainD}:${gainD}:1`};
    this.byId("command").textContent = Object.entries(options)
      .map(([job, own]) => ["holdfast", job].join(" ") + own + (words.length ? " " + words.join(" ") : "")).join("\n");
  }

  async saveCase() {
    const answer = await this.quick.ask("case file", {call: "save", settings: this.state.list()});
    if (answer === null) return;
    if (answer.code === 0) save("case.toml", answer.text, "application/toml");
    else this.judge(answer);
  }

  async loadCase(file) {
    if (!file) return;
    const before = this.base;
    this.base = {name: file.name, text: await file.text(), opened: true};
    this.quick.reload(this.base.text);
    if (!await this.readCase()) {
      this.base = before;
      this.quick.reload(before.text);
      return;
    }
    this.thorough.reload(this.base.text);
    this.state.changed.clear();
    this.buildFields();
    for (const figure of [this.chart, this.history, this.phase, this.amplitudes]) figure.clear();
    this.cellsOf = this.shownAmplitudes = null;
    this.frameChart();
    this.refuse([]);
    this.refresh();
  }
}

if (typeof WebAssembly === "object" && typeof DecompressionStream === "function") {
  globalThis.explorer = new Explorer();
  globalThis.explorer.open();
} else {
  document.getElementById("verdict").textContent = "This browser is too old for the explorer: it has no WebAssembly or no DecompressionStream.";
}
