// The page: settings ask, engines answer, figures show.

/// The rows of a CSV text, by its header.
const rowsOf = (text) => d3.csvParse(text);
const column = (rows, name, factor = 1) => rows.map((row) => (row[name] === "" ? NaN : factor * Number(row[name])));

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
    this.module = await compiledModule();
    this.quick = new Engine(this.module, this.base.text);
    this.thorough = new Engine(this.module, this.base.text);
    await this.readCase();
    this.state.fromAddress(location.hash.slice(1));
    this.buildFields();
    this.buildFigures();
    this.wire();
    this.refresh();
  }

  /// The values of the case itself.
  async readCase() {
    const answer = await this.quick.ask("case", {call: "job", words: ["case"], settings: []});
    if (answer.code !== 0) return this.refuse(answer.notes);
    this.state.own = new Map(rowsOf(answer.text).filter((row) => settingOf(row.key))
      .map((row) => [row.key, row.value.replace(/^"(.*)"$/s, "$1")]));
    this.byId("case-name").textContent = this.base.name || "the built-in case";
    return undefined;
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
    const [p, d] = gainKeys.map((key) => Number(this.state.own.get(key)));
    const aboutP = sizeOf(p, 500), aboutD = sizeOf(d, 10);
    this.chart.frame([p - aboutP, p + 1.5 * aboutP], [d - 2.2 * aboutD, d + 2.2 * aboutD]);
  }

  wire() {
    const on = (id, action) => this.byId(id).addEventListener("click", action);
    on("save-case", () => this.saveCase());
    on("copy-link", () => navigator.clipboard?.writeText(location.href));
    on("reset", () => { this.state.changed.clear(); this.frameChart(); this.showState(); this.refresh(); });
    on("theme", () => this.turnTheme());
    this.byId("load-case").addEventListener("change", (event) => this.loadCase(event.target.files[0]));
    this.byId("controls").addEventListener("submit", (event) => event.preventDefault());
    addEventListener("hashchange", () => {
      if (location.hash.slice(1) === this.state.toAddress()) return;
      this.state.fromAddress(location.hash.slice(1));
      this.showState();
      this.refresh();
    });
    const dark = matchMedia("(prefers-color-scheme: dark)");
    dark.addEventListener("change", () => this.refresh());
    this.byId("theme").textContent = dark.matches ? "Light" : "Dark";
  }

  turnTheme() {
    const root = document.documentElement;
    const dark = root.dataset.theme ? root.dataset.theme === "dark" : matchMedia("(prefers-color-scheme: dark)").matches;
    root.dataset.theme = dark ? "light" : "dark";
    this.byId("theme").textContent = dark ? "Dark" : "Light";
    if (this.chart.last) this.chart.drawCells(this.chart.last);
  }

  showState() { this.fields.forEach((field) => field.show()); }

  change(key) {
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
    const address = this.state.toAddress();
    history.replaceState(null, "", address ? `#${address}` : location.pathname + location.search);
    this.chart.drawPoint(gainKeys.map((key) => this.state.number(key)));
    this.chart.axes();
    this.askCells();
    this.askMotion();
    this.askAmplitudes();
    this.showCommand();
    clearTimeout(this.resting);
    this.resting = setTimeout(() => this.askThorough(), 250);
    this.thorough.abandon();
    for (const id of ["verdict-card", "margins", "answers"]) this.byId(id).classList.add("waiting");
  }

  async askCells() {
    const conductor = this.state.text(modelKey) !== "two_masses";
    const signature = this.state.signature(...gainKeys) + JSON.stringify(this.chart.window());
    if (conductor && signature === this.cellsOf) return;  // the gains move, their plane stays
    const answer = await this.quick.ask("cells", {call: "cells", settings: this.state.list(),
      count: conductor ? 80 : cellsAcross, ...this.chart.window()});
    if (answer === null) return;
    this.judge(answer);
    this.chart.waiting(answer.code !== 0);
    if (answer.code !== 0) return;
    this.cellsOf = signature;
    this.chart.drawCells(answer);
    this.sayStability();
  }

  sayStability() {
    const cell = this.chart.cellOfPoint();
    const words = cell === undefined ? "outside the window" : cell ? "stable" : "not stable";
    this.chart.say(`Shaded: stable without play; the line is the exact boundary. The case's gains: ${words}.`);
  }

  async askMotion() {
    const answer = await this.quick.ask("motion", {call: "job",
      words: ["simulate", "--duration", String(this.duration())], settings: this.state.list()});
    if (answer === null) return;
    for (const figure of [this.history, this.phase]) figure.waiting(answer.code !== 0);
    if (answer.code !== 0) return;
    this.drawMotion(answer.text);
  }

  /// Twenty periods of the force, of two thousand samples at most.
  duration() {
    const period = 1 / this.state.number("excitation.frequency");
    const most = 2000 * this.state.number("control.sampling_period");
    const wanted = Math.min(20 * period, most);
    return Number.isFinite(wanted) && wanted > 0 ? Number(wanted.toPrecision(6)) : 1;
  }

  drawMotion(text) {
    const rows = rowsOf(text);
    const time = column(rows, "time_s"), z = column(rows, "z1_m", 1e3), v = column(rows, "v1_m_per_s", 1e3);
    const inPlay = column(rows, "in_backlash").map((flag) => flag === 1);
    this.history.draw([{name: "conductor", style: "first", x: time, y: z}], {bands: bandsOf(time, inPlay)});
    this.history.say("Shaded: the drive is in the play of its belt and exerts no force.");
    this.history.csv = this.phase.csv = text;
    const half = time.length >> 1;
    const where = (flag) => v.map((value, k) => (k >= half && (inPlay[k] === flag || inPlay[k - 1] === flag) ? value : NaN));
    const series = [{name: "force acts", style: "first", x: z, y: where(false), byPoint: true},
      {name: "in the play", style: "play", x: z, y: where(true), byPoint: true}];
    this.phase.draw(series, {x: extentOf(z.slice(half))});
    this.phase.say("The conductor's displacement and velocity at the samples.");
  }

  async askAmplitudes() {
    const range = {from: 3, to: 60, count: 115};
    const ask = (model) => this.quick.ask(`amplitudes of ${model}`, {call: "amplitudes", ...range,
      settings: this.state.list({[modelKey]: model})});
    const beside = this.state.text(modelKey) === "two_masses" ? "cable" : this.state.text(modelKey);
    const [masses, cable] = await Promise.all([ask("two_masses"), ask(beside)]);
    if (masses === null || cable === null) return;
    const failed = masses.code !== 0 && cable.code !== 0;
    this.amplitudes.waiting(failed);
    if (!failed) this.drawAmplitudes(masses, cable, beside);
  }

  drawAmplitudes(masses, cable, beside) {
    const part = (answer, place) => (answer.code === 0 ? Array.from(answer.rows).filter((_, k) => k % 3 === place) : []);
    const left = (answer) => part(answer, 1).map((value, k) => 100 * value / part(answer, 2)[k]);
    const x = part(masses.code === 0 ? masses : cable, 0);
    const names = {cable: "the cable", string: "the taut conductor", infinite_string: "without ends"};
    const series = [{name: "two masses", style: "first", x, y: left(masses)},
      {name: names[beside], style: "second dashed", x, y: left(cable)},
      {name: "without control", style: "third", x, y: x.map(() => 100)}];
    const largest = Math.min(300, d3.max(series.flatMap((one) => one.y), (value) => (Number.isFinite(value) ? value : 0)));
    this.amplitudes.draw(series.filter((one) => one.y.length > 0), {x: [3, 60], y: [0, 1.08 * largest]});
    const unstable = [[masses, "two masses"], [cable, names[beside]]]
      .filter(([answer]) => answer.code === 0 && part(answer, 1).every(Number.isNaN)).map(([, name]) => name);
    this.amplitudes.say(unstable.length ? `No steady vibration without play on ${unstable.join(" and ")}: the loop is not stable.`
      : "Of the steady vibration without play, against that without control.");
    const rows = x.map((f, k) => [f, part(masses, 1)[k], part(masses, 2)[k], part(cable, 1)[k], part(cable, 2)[k]].join(","));
    this.amplitudes.csv = ["frequency_Hz,two_masses_m,two_masses_uncontrolled_m,conductor_m,conductor_uncontrolled_m", ...rows, ""].join("\n");
  }

  askThorough() {
    this.askBoundary();
    this.askVerdict();
    this.askMargins();
    this.askAnswers();
  }

  async job(kind, words) {
    return this.thorough.ask(kind, {call: "job", words, settings: this.state.list()});
  }

  async askBoundary() {
    const {p} = this.chart.window();
    const answer = await this.job("boundary", ["boundary", `--p=${p[0]}:${p[1]}`]);
    if (answer === null) return;
    this.chart.drawBoundary(answer.code === 0 ? rowsOf(answer.text) : []);
  }

  async askVerdict() {
    const answer = await this.job("verdict", ["verdict"]);
    if (answer === null) return;
    this.judge(answer);
    this.byId("verdict-card").classList.remove("waiting");
    const row = answer.code === 0 ? rowsOf(answer.text)[0] : null;
    const period = row && Number(row.period_s) > 0 ? `, ${numbers(Number(row.period_s))} s` : "";
    this.byId("verdict").textContent = row ? row.verdict + period + (row.certified === "1" ? " — certified" : "") : "no verdict";
    this.byId("verdict-grounds").textContent = row ? row.rests_on : "";
    this.byId("notes").replaceChildren(...(answer.code === 0 ? answer.notes : []).map((note) => {
      const item = document.createElement("li");
      item.textContent = note;
      return item;
    }));
  }

  async askMargins() {
    const answer = await this.job("margins", ["margins"]);
    if (answer === null) return;
    this.byId("margins").classList.remove("waiting");
    const box = this.byId("margins").querySelector(".scrolling");
    if (answer.code !== 0) return void (box.textContent = answer.notes.join(" "));
    box.replaceChildren(this.table(["quantity", "side", "from", "to", "distance", "what happens there"],
      rowsOf(answer.text).map((row) => [`${row.quantity.replaceAll("_", " ")} (${row.unit})`, row.side,
        numbers(Number(row.value)), row.outcome === "boundary" ? numbers(Number(row.position)) : "",
        row.outcome === "boundary" ? numbers(Number(row.distance)) : row.outcome.replaceAll("_", " "),
        row.curve.replaceAll("_", " ") + (Number(row.frequency_Hz) > 0 ? ` at ${numbers(Number(row.frequency_Hz))} Hz` : "")])));
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
    if (answer.code !== 0) return void (list.textContent = answer.notes.join(" "));
    list.replaceChildren(...rowsOf(answer.text).flatMap((row) => [
      Object.assign(document.createElement("dt"), {textContent: row.question}),
      Object.assign(document.createElement("dd"), {textContent: row.answer})]));
  }

  /// Shows what is wrong with the settings where the program says so, at the field that it names.
  judge(answer) {
    const words = answer.code === 0 ? "" : answer.notes.filter((note) => !note.startsWith("warning:")).join(" ");
    let told = false;
    for (const field of this.fields) {
      const own = words.includes(field.setting.key) ? words : "";
      field.refuse(own);
      told = told || own !== "";
    }
    this.refuse(words && !told ? [words] : []);
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
    const options = {verdict: "", margins: "", answers: "", simulate: ` --duration ${this.duration()}`,
      stability: ` --p=${p[0]}:${p[1]}:${cellsAcross} --d=${d[0]}:${d[1]}:${cellsAcross}`};
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
    this.base = {name: file.name, text: await file.text()};
    this.quick.reload(this.base.text);
    const answer = await this.quick.ask("case", {call: "job", words: ["case"], settings: []});
    if (answer.code !== 0) {
      this.base = before;
      this.quick.reload(before.text);
      return void this.refuse(answer.notes);
    }
    this.thorough.reload(this.base.text);
    this.state.changed.clear();
    await this.readCase();
    this.buildFields();
    this.frameChart();
    this.refuse([]);
    this.cellsOf = null;
    return this.refresh();
  }
}

if (typeof WebAssembly === "object" && typeof DecompressionStream === "function") {
  globalThis.explorer = new Explorer();
  globalThis.explorer.open();
} else {
  document.getElementById("verdict").textContent = "This browser is too old for the explorer: it has no WebAssembly or no DecompressionStream.";
}
