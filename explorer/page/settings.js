// What can be changed, and its state: the text of each key in the units of the case file, where it
// differs from the case's own.

/// A key of the case with its field. `power`: of ten, of the shown unit in the case's; `range`: of
/// the slider, from the case's own value, in shown units.
const settings = [
  {key: "control.proportional_gain", label: "Proportional gain P", unit: "N/m", power: 0,
    range: (own) => [own - 2 * sizeOf(own, 500), own + 2 * sizeOf(own, 500)]},
  {key: "control.differential_gain", label: "Differential gain D", unit: "N s/m", power: 0,
    range: (own) => [own - 3 * sizeOf(own, 10), own + 3 * sizeOf(own, 10)]},
  {key: "control.sampling_period", label: "Sampling period τ", unit: "ms", power: -3, ratios: true,
    range: (own) => [own / 20, own * 40]},
  {key: "control.processing_delay", label: "Processing delay δ", unit: "ms", power: -3,
    range: (own) => [0, Math.max(10, 4 * own)]},
  {key: "backlash.width", label: "Play of the belt r₀", unit: "mm", power: -3,
    range: (own) => [0, Math.max(1, 6 * own)]},
  {key: "absorber.clamp_mass", label: "Clamp mass", unit: "g", power: -3,
    range: (own) => [0, Math.max(20, 4 * own)]},
  {key: "excitation.frequency", label: "Frequency of the force f", unit: "Hz", power: 0, ratios: true,
    range: (own) => [own / 10, own * 6]},
  {key: "excitation.amplitude", label: "Amplitude of the force F", unit: "N", power: 0,
    range: (own) => [0, 4 * sizeOf(own, 1)]},
  {key: "weather.temperature", label: "Temperature of the conductor", unit: "°C", power: 0,
    range: () => [-40, 100]},
  {key: "plant.model", label: "What the absorber hangs on", choices: {
    two_masses: "two masses", string: "the taut conductor", cable: "the hanging cable",
    infinite_string: "the conductor without ends"}},
  {key: "plant.modes", label: "Modes of the conductor", unit: "", power: 0, ofConductor: true,
    range: () => [1, 200]},
];
const modelKey = "plant.model", modesKey = "plant.modes";

const sizeOf = (value, otherwise) => Math.abs(value) || otherwise;
const settingOf = (key) => settings.find((setting) => setting.key === key);

const decimal = /^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i;

/// The text with the exponent of ten moved, so that no digit is rounded; other texts as they are,
/// for the program to refuse in its words.
function shifted(text, power) {
  if (!decimal.test(text)) return text;
  const [written, exponent] = text.toLowerCase().split("e");
  const mantissa = written.replace(/^([+-]?)\./, "$10.").replace(/\.$/, "");  // as a case file has it
  return power === 0 && exponent === undefined ? mantissa : `${mantissa}e${Number(exponent ?? 0) + power}`;
}

/// The case's text of a number as it is shown in a unit.
function shown(text, power) {
  const plain = text.replace(/^"(.*)"$/s, "$1");
  if (!decimal.test(plain)) return plain;
  return String(Number(Number(shifted(plain, -power)).toPrecision(14)));
}

class State {
  constructor() {
    this.own = new Map(); // of the case itself, by the program's job `case`
    this.changed = new Map();
  }

  text(key) { return this.changed.get(key) ?? this.own.get(key) ?? ""; }
  number(key) { return Number(this.text(key)); }

  set(key, text) {
    if (text === this.own.get(key)) this.changed.delete(key);
    else this.changed.set(key, text);
  }

  /// [key, value] of what differs.
  list(changes = {}) { return [...new Map([...this.changed, ...Object.entries(changes)])]; }

  /// The same without some keys: what a result depends on if not on them.
  signature(...without) {
    return JSON.stringify(this.list().filter(([key]) => !without.includes(key)));
  }

  toAddress() { return new URLSearchParams([...this.changed]).toString(); }

  fromAddress(text) {
    this.changed.clear();
    for (const [key, value] of new URLSearchParams(text))
      if (settingOf(key)) this.set(key, value.replace(/[\r\n]+/g, " "));
  }
}

/// One field of the form: a label, the number as text with its unit and a slider, or a choice.
class Field {
  constructor(setting, state, changed) {
    Object.assign(this, {setting, state, changed});
    this.element = document.createElement("div");
    this.element.className = "setting";
    const label = document.createElement("label");
    label.textContent = setting.label;
    label.htmlFor = setting.key;
    this.hint = document.createElement("p");
    this.hint.className = "hint";
    this.hint.id = `${setting.key}-hint`;
    this.element.append(label, ...(setting.choices ? this.choice() : this.numbers()), this.hint);
  }

  choice() {
    this.input = document.createElement("select");
    for (const [value, words] of Object.entries(this.setting.choices))
      this.input.append(new Option(words, value));
    this.input.addEventListener("change", () => this.enter(this.input.value));
    this.identify();
    return [this.input];
  }

  numbers() {
    const {setting} = this;
    this.input = document.createElement("input");
    Object.assign(this.input, {type: "text", inputMode: "decimal", spellcheck: false});
    this.input.addEventListener("input", () => this.enter(shifted(this.input.value.trim(), setting.power)));
    this.identify();
    const unit = document.createElement("span");
    unit.className = "unit";
    unit.textContent = setting.unit;
    const entry = document.createElement("div");
    entry.className = "entry";
    entry.append(this.input, unit);
    this.slider = document.createElement("input");
    Object.assign(this.slider, {type: "range", min: 0, max: 1000, step: 1});
    this.slider.setAttribute("aria-label", `${setting.label}, slider`);
    this.slider.addEventListener("input", () => this.slide());
    return [entry, this.slider];
  }

  identify() {
    this.input.id = this.setting.key;
    this.input.setAttribute("aria-describedby", this.hint.id);
  }

  enter(text) {
    this.state.set(this.setting.key, text);
    if (this.slider) this.placeSlider();
    this.changed(this.setting.key);
  }

  scale() {
    const own = Number(shown(this.state.own.get(this.setting.key) ?? "", this.setting.power)) || 0;
    const range = this.setting.range(own);
    return (this.setting.ratios ? d3.scaleLog() : d3.scaleLinear()).domain(range).range([0, 1000]);
  }

  slide() {
    const value = this.scale().invert(Number(this.slider.value));
    const digits = this.setting.key === modesKey ? value.toFixed(0) : String(Number(value.toPrecision(4)));
    this.input.value = digits;
    this.state.set(this.setting.key, shifted(digits, this.setting.power));
    this.say();
    this.changed(this.setting.key);
  }

  say() {
    this.slider.setAttribute("aria-valuetext", `${this.input.value} ${this.setting.unit}`);
  }

  placeSlider() {
    const place = this.scale()(Number(shown(this.state.text(this.setting.key), this.setting.power)));
    if (Number.isFinite(place)) this.slider.value = place;
    this.say();
  }

  /// Shows the state's own text, unless it is being written.
  show() {
    const text = this.state.text(this.setting.key);
    if (this.setting.choices) this.input.value = text;
    else if (document.activeElement !== this.input) this.input.value = shown(text, this.setting.power);
    if (this.slider) this.placeSlider();
    const hasModes = ["string", "cable"].includes(this.state.text(modelKey));
    // With wind no force is given, without [stringing] no temperature.
    const given = this.setting.choices || this.state.own.has(this.setting.key);
    this.element.hidden = !given || (Boolean(this.setting.ofConductor) && !hasModes);
  }

  /// What the program has against it; nothing where it has nothing.
  refuse(words) {
    this.hint.textContent = words;
    if (words) this.input.setAttribute("aria-invalid", "true");
    else this.input.removeAttribute("aria-invalid");
  }
}
