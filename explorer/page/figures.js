// Figures of lines over two axes, by D3, with a legend, the values under the pointer, and what they
// show as SVG and CSV.

const numbers = d3.format(".4~g");
const ticked = (axis, count) => axis.ticks(count).tickSizeOuter(0);

/// A place of the picture that is far outside at most, not beyond what a path can hold.
const drawable = (place) => Math.min(Math.max(place, -1e5), 1e5);

/// A download of a text.
function save(name, text, type) {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(new Blob([text], {type}));
  link.download = name;
  document.body.append(link);
  link.click();
  link.remove();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}

const drawnProperties = ["fill", "stroke", "stroke-width", "stroke-dasharray", "stroke-linejoin", "opacity",
  "font-family", "font-size", "image-rendering"];

/// The picture by itself: what the page's style says of each part stands in the part.
function standalone(svg) {
  const copy = svg.cloneNode(true);
  const originals = svg.querySelectorAll("*"), copies = copy.querySelectorAll("*");
  originals.forEach((element, k) => {
    const style = getComputedStyle(element);
    for (const property of drawnProperties) copies[k].style.setProperty(property, style.getPropertyValue(property));
  });
  const paper = getComputedStyle(document.documentElement).getPropertyValue("--card");
  copy.setAttribute("xmlns", "http://www.w3.org/2000/svg");
  copy.style.background = paper;
  return new XMLSerializer().serializeToString(copy);
}

/// The frame that all figures share: heading, buttons, axes with labels, legend, the line of words
/// below. As wide as its place in the page, whose letters it so shares.
class Figure {
  /// @param words   title, x, y: labels; name: of saved files
  /// @param height  in the page's pixels
  constructor(id, words, height) {
    this.words = {...words, caption: ""};
    this.height = height;
    this.margin = {top: 40, right: 14, bottom: 44, left: 58};
    this.root = d3.select(`#${id}`);
    const top = this.root.append("div").attr("class", "top");
    top.append("h2").text(words.title).attr("id", `${id}-heading`);
    this.tools = top.append("div").attr("class", "tools");
    this.box = this.root.append("div").attr("class", "picture");
    this.svg = this.box.append("svg");
    this.svg.append("title").text(words.title);
    this.svg.attr("role", "img").attr("aria-labelledby", `${id}-heading ${id}-caption`);
    this.caption = this.root.append("figcaption").attr("id", `${id}-caption`);
    this.clip = this.svg.append("clipPath").attr("id", `${id}-clip`).append("rect");
    this.under = this.svg.append("g");
    this.xAxis = this.svg.append("g").attr("class", "axis");
    this.yAxis = this.svg.append("g").attr("class", "axis");
    this.plot = this.svg.append("g").attr("clip-path", `url(#${id}-clip)`);
    this.xLabel = this.svg.append("text").attr("class", "label").attr("text-anchor", "middle").text(words.x);
    this.yLabel = this.svg.append("text").attr("class", "label").attr("text-anchor", "middle").text(words.y);
    this.legend = this.svg.append("g");
    this.x = d3.scaleLinear();
    this.y = d3.scaleLinear();
    this.csv = "";
    this.savers = [this.button("SVG", `Save the figure “${words.title}” as SVG`, () =>
      save(`${words.name}.svg`, this.picture(), "image/svg+xml")),
    this.button("CSV", `Save the numbers of “${words.title}” as CSV`, () => this.saveNumbers())];
    this.layOut();
    new ResizeObserver(() => { if (this.layOut()) this.redraw(); }).observe(this.box.node());
  }

  /// Fits everything to the width that there is; whether it has changed.
  layOut() {
    const width = Math.max(240, this.box.node().clientWidth);
    if (width === this.width) return false;
    this.width = width;
    const {margin, height} = this;
    this.inner = {left: margin.left, right: width - margin.right, top: margin.top, bottom: height - margin.bottom};
    const {left, right, top, bottom} = this.inner;
    this.svg.attr("viewBox", `0 0 ${width} ${height}`).attr("width", width).attr("height", height);
    this.clip.attr("x", left).attr("y", top).attr("width", right - left).attr("height", bottom - top);
    this.xAxis.attr("transform", `translate(0,${bottom})`);
    this.yAxis.attr("transform", `translate(${left},0)`);
    this.xLabel.attr("x", (left + right) / 2).attr("y", height - 8);
    this.yLabel.attr("transform", `translate(14,${(top + bottom) / 2}) rotate(-90)`);
    this.x.range([left, right]);
    this.y.range([bottom, top]);
    return true;
  }

  button(words, meaning, action) {
    return this.tools.append("button").attr("type", "button").attr("aria-label", meaning).attr("title", meaning)
      .text(words).on("click", action);
  }

  picture() { return standalone(this.svg.node()); }

  saveNumbers() { save(`${this.words.name}.csv`, this.csv, "text/csv"); }

  axes() {
    this.xAxis.call(ticked(d3.axisBottom(this.x), Math.max(3, Math.min(10, this.width / 80))));
    this.yAxis.call(ticked(d3.axisLeft(this.y), 6));
  }

  label(x, y) {
    Object.assign(this.words, {x, y});
    this.xLabel.text(x);
    this.yLabel.text(y);
  }

  say(text) {
    this.words.caption = text;
    this.caption.text(text);
  }

  /// Whether what it shows is not of the settings, for they were refused: then it is dimmed.
  refused(is) {
    this.root.classed("waiting", is);
    for (const button of this.savers) button.attr("disabled", is ? "" : null);
    if (is) this.caption.text("Not computed: see the settings.");
  }

  /// Whether a place of the picture is inside the axes.
  holds([left, top]) {
    const {inner} = this;
    return left >= inner.left && left <= inner.right && top >= inner.top && top <= inner.bottom;
  }
}

/// The ends of all finite values, a little wider; of none and of one value something about it.
function extentOf(values, around = 0.04) {
  const [low, high] = d3.extent(values.filter((value) => Math.abs(value) < 1e300));
  if (low === undefined) return [-1, 1];
  const room = (high - low || Math.abs(high) || 1) * around;
  return [low - room, high + room];
}

/// Lines over an axis, or over each other.
class LineFigure extends Figure {
  constructor(id, words) {
    super(id, words, 310);
    this.marks = this.plot.append("g");
    this.cross = this.svg.append("line").attr("class", "cross").attr("visibility", "hidden");
    this.svg.on("mousemove", () => this.point(d3.mouse(this.svg.node())))
      .on("mouseleave", () => this.leave());
  }

  /// @param series  [{name, style, x: [], y: [], byPoint}], NaN breaking a line;
  ///                byPoint: no function of x, so that it tells no value there
  /// @param bands   [[from, to]] of x, shaded
  /// @param mark    {x, y}: a place of x, and a dot there where y is a number
  draw(series, {x, y, bands = [], mark} = {}) {
    this.series = series;
    this.drawn = {x, y, bands, mark};
    this.x.domain(x ?? extentOf(series.flatMap((one) => Array.from(one.x)), 0));
    this.y.domain(y ?? extentOf(series.flatMap((one) => Array.from(one.y))));
    this.axes();
    const line = d3.line().defined(([at, value]) => Number.isFinite(this.x(at)) && Number.isFinite(this.y(value)))
      .x(([value]) => drawable(this.x(value))).y(([, value]) => drawable(this.y(value)));
    const pairs = (one) => Array.from(one.x, (value, k) => [value, one.y[k]]);
    const rects = this.plot.selectAll("rect.band").data(bands);
    rects.exit().remove();
    rects.enter().append("rect").attr("class", "band").merge(rects)
      .attr("x", ([from]) => this.x(from)).attr("width", ([from, to]) => Math.max(0.5, this.x(to) - this.x(from)))
      .attr("y", this.inner.top).attr("height", this.inner.bottom - this.inner.top);
    const paths = this.plot.selectAll("path.line").data(series);
    paths.exit().remove();
    paths.enter().append("path").merge(paths)
      .attr("class", (one) => `line ${one.style}`).attr("d", (one) => line(pairs(one)));
    this.mark(mark);
    this.name(series.filter((one) => one.name));
  }

  mark(mark) {
    this.marks.selectAll("*").remove();
    if (!mark || !Number.isFinite(this.x(mark.x))) return;
    this.marks.append("line").attr("class", "cross").attr("x1", this.x(mark.x)).attr("x2", this.x(mark.x))
      .attr("y1", this.inner.top).attr("y2", this.inner.bottom);
    if (Number.isFinite(mark.y))
      this.marks.append("circle").attr("class", "mark").attr("r", 5).attr("cx", this.x(mark.x)).attr("cy", drawable(this.y(mark.y)));
  }

  /// Nothing any more: another case has come.
  clear() {
    this.draw([]);
    this.csv = "";
    this.say("");
  }

  redraw() {
    if (this.series) this.draw(this.series, this.drawn);
  }

  /// The legend, in one row above the axes or two.
  name(named) {
    this.legend.selectAll("*").remove();
    let left = this.inner.left, row = 0;
    for (const one of named) {
      const entry = this.legend.append("g");
      entry.append("path").attr("class", `line ${one.style}`).attr("d", "M0,-4H22");
      const words = entry.append("text").attr("x", 27).text(one.name);
      const width = 27 + words.node().getComputedTextLength();
      if (left + width > this.inner.right && row === 0) [left, row] = [this.inner.left, 1];
      entry.attr("transform", `translate(${left},${14 + 16 * row})`);
      left += width + 18;
    }
  }

  /// The values at the place, in words below the figure.
  point(place) {
    if (!this.holds(place) || !this.series?.length || this.root.classed("waiting")) return this.leave();
    const at = this.x.invert(place[0]);
    const values = this.series.filter((one) => one.name && one.x.length > 0 && !one.byPoint)
      .map((one) => [one.name, one.y[nearest(one.x, at)]]);
    const words = values.map(([name, value]) => `${name}: ${Number.isFinite(value) ? numbers(value) : "none"}`);
    const second = values.length ? "" : `, ${this.words.y}: ${numbers(this.y.invert(place[1]))}`;
    this.caption.text(`${this.words.x}: ${numbers(at)}${second}${words.length ? " — " + words.join("; ") : ""}`);
    this.cross.attr("x1", place[0]).attr("x2", place[0]).attr("y1", this.inner.top).attr("y2", this.inner.bottom)
      .attr("visibility", "visible");
    return undefined;
  }

  leave() {
    this.cross.attr("visibility", "hidden");
    if (!this.root.classed("waiting")) this.caption.text(this.words.caption);
  }
}

/// The place of the value in an ascending list that is nearest.
function nearest(list, value) {
  const place = Math.min(Math.max(d3.bisectLeft(list, value), 1), list.length - 1);
  return value - list[place - 1] < list[place] - value ? place - 1 : place;
}
