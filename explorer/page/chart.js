// The stability chart over P and D: cells, exact boundary, and the case's point to drag.

const gainKeys = ["control.proportional_gain", "control.differential_gain"];
const cellsAcross = 200;

class StabilityFigure extends Figure {
  /// @param moved   called with the gains of the point while it moves
  /// @param framed  called when the window has changed
  constructor(id, moved, framed) {
    super(id, {title: "Which gains are stable?", x: "P (N/m)", y: "D (N s/m)", name: "stability"}, 460);
    this.moved = moved;
    this.framed = framed;
    this.svg.attr("role", "group");  // there is something to take hold of in it
    this.pane = this.box.insert("div", "svg").attr("class", "window").attr("aria-hidden", "true");
    this.canvas = this.pane.append("canvas").node();
    this.frameLine = this.svg.append("rect").attr("class", "frame");
    this.boundary = this.plot.append("g");
    this.addHandle();
    this.addZoom();
    this.place();
  }

  /// The cells are pixels of a canvas under the axes.
  place() {
    const {left, right, top, bottom} = this.inner;
    this.pane.style("left", `${left}px`).style("top", `${top}px`).style("width", `${right - left}px`)
      .style("height", `${bottom - top}px`);
    this.frameLine.attr("x", left).attr("y", top).attr("width", right - left).attr("height", bottom - top);
  }

  /// The canvas where its cells belong in the window of now: each reaches half a step about its gains.
  placeCells() {
    if (!this.last) return;
    const {p, d, count} = this.last;
    const stepP = (p[1] - p[0]) / (count - 1), stepD = (d[1] - d[0]) / (count - 1);
    const left = this.x(p[0] - stepP / 2), right = this.x(p[1] + stepP / 2);
    const top = this.y(d[1] + stepD / 2), bottom = this.y(d[0] - stepD / 2);
    this.cellBox = {left, top, width: right - left, height: bottom - top};
    Object.assign(this.canvas.style, {left: `${left - this.inner.left}px`, top: `${top - this.inner.top}px`,
      width: `${right - left}px`, height: `${bottom - top}px`});
  }

  redraw() {
    this.place();
    this.placeCells();
    this.axes();
    this.drawBoundary(this.rows ?? []);
    if (this.gains) this.drawPoint(this.gains);
  }

  addHandle() {
    this.handle = this.svg.append("g").attr("class", "handle").attr("tabindex", 0).attr("role", "slider")
      .attr("aria-label", "The case's gains; arrow keys move them").style("touch-action", "none");
    this.handle.append("circle").attr("class", "grip").attr("r", 22);
    this.handle.append("circle").attr("class", "dot").attr("r", 7);
    this.handle.call(d3.drag().container(() => this.svg.node())
      .on("drag", () => this.moveTo(d3.event.x, d3.event.y)));
    this.handle.on("keydown", () => this.step(d3.event));
  }

  moveTo(left, top) {
    const {inner} = this;
    const within = (value, low, high) => Math.min(Math.max(value, low), high);
    const p = this.x.invert(within(left, inner.left, inner.right));
    const d = this.y.invert(within(top, inner.top, inner.bottom));
    const rounded = (value) => String(Number(value.toPrecision(4)));
    this.moved([rounded(p), rounded(d)]);
  }

  step(event) {
    const directions = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1]};
    const direction = directions[event.key];
    if (!direction) return;
    event.preventDefault();
    const pace = event.shiftKey ? 20 : 4;
    this.moveTo(this.x(this.gains[0]) + pace * direction[0], this.y(this.gains[1]) + pace * direction[1]);
  }

  addZoom() {
    const zoom = d3.zoom().scaleExtent([0.05, 1e6])
      .filter(() => !d3.event.button && d3.event.type !== "touchstart" &&
        (d3.event.type !== "wheel" || d3.event.ctrlKey || d3.event.metaKey))
      .on("zoom", () => {
        this.x.domain(d3.event.transform.rescaleX(this.x.copy().domain(this.whole.p)).domain());
        this.y.domain(d3.event.transform.rescaleY(this.y.copy().domain(this.whole.d)).domain());
        this.redraw();
        this.framed();
      });
    this.zoom = zoom;
    this.svg.call(zoom).on("dblclick.zoom", null);
    this.svg.on("click", () => {  // not after a drag, which d3.zoom keeps from it
      const place = d3.mouse(this.svg.node());
      if (this.holds(place)) this.moveTo(...place);
    });
    this.button("Zoom in", "Zoom in about the point of the chart", () => this.scaleBy(1.6));
    this.button("Zoom out", "Zoom out, to more of the plane of gains", () => this.scaleBy(1 / 1.6));
    this.button("Whole", "Whole window of the chart, as at first", () => this.svg.call(zoom.transform, d3.zoomIdentity));
  }

  scaleBy(factor) {
    const about = this.holds(this.pointPlace()) ? this.pointPlace() : undefined;
    this.svg.call(this.zoom.scaleBy, factor, about);
  }

  pointPlace() { return [this.x(this.gains[0]), this.y(this.gains[1])]; }

  /// The window that "Whole" comes back to.
  frame(p, d) {
    this.whole = {p, d};
    this.x.domain(p);
    this.y.domain(d);
    this.svg.property("__zoom", d3.zoomIdentity);
  }

  /// The gains P of the window and as many again on each side, so that curves that leave it go on.
  widerGains() {
    const {p} = this.window();
    return [2 * p[0] - p[1], 2 * p[1] - p[0]];
  }

  /// To six digits, as it stands in commands too.
  window() {
    const rounded = (domain) => domain.map((value) => Number(value.toPrecision(6)));
    return {p: rounded(this.x.domain()), d: rounded(this.y.domain())};
  }

  /// @param answer  of the request `cells`
  drawCells({cells, count, p, d}) {
    const style = getComputedStyle(document.documentElement);
    // A pixel's four bytes in one number, red first in memory.
    const [unstable, stable] = ["--unstable", "--stable"].map((name) => {
      const {r, g, b} = d3.rgb(style.getPropertyValue(name).trim());
      return new Uint32Array(new Uint8Array([r, g, b, 255]).buffer)[0];
    });
    Object.assign(this.canvas, {width: count, height: count});
    const context = this.canvas.getContext("2d");
    const image = context.createImageData(count, count);
    const pixels = new Uint32Array(image.data.buffer);
    for (let i = 0; i < count; ++i)
      for (let j = 0; j < count; ++j)
        pixels[(count - 1 - j) * count + i] = cells[i * count + j] ? stable : unstable;
    context.putImageData(image, 0, 0);
    this.last = {cells, count, p, d};
    this.placeCells();
    this.axes();
  }

  /// Nothing any more: another case has come.
  clear() {
    this.last = null;
    this.canvas.width = this.canvas.height = 1;
    this.drawBoundary([]);
    this.say("");
  }

  /// @param rows  of the job `boundary`
  drawBoundary(rows) {
    this.rows = rows;
    const [low, high] = this.y.domain();
    const far = 20 * (high - low);
    const curves = [];
    let before = null;
    for (const row of rows) {
      const point = [Number(row.proportional_gain), Number(row.differential_gain)];
      const jumps = before && (before.curve !== row.curve || Math.abs(point[1] - before.point[1]) > far);
      if (!before || jumps) curves.push([]);
      curves[curves.length - 1].push(point);
      before = {curve: row.curve, point};
    }
    const line = d3.line().x(([p]) => this.x(p)).y(([, d]) => drawable(this.y(d)));
    const paths = this.boundary.selectAll("path").data(curves);
    paths.exit().remove();
    paths.enter().append("path").attr("class", "boundary").merge(paths).attr("d", line);
  }

  drawPoint(gains) {
    this.gains = gains;
    const known = gains.every(Number.isFinite);
    this.handle.attr("visibility", known ? "visible" : "hidden");
    if (!known) return;
    const [left, top] = this.pointPlace();
    const {inner} = this;
    const inside = [Math.min(Math.max(left, inner.left), inner.right), Math.min(Math.max(top, inner.top), inner.bottom)];
    this.handle.attr("transform", `translate(${inside})`);
    const [low, high] = this.y.domain();
    this.handle.attr("aria-valuemin", low).attr("aria-valuemax", high).attr("aria-valuenow", gains[1])
      .attr("aria-valuetext", `P ${numbers(gains[0])} N/m, D ${numbers(gains[1])} N s/m`);
  }

  /// The cell in which the point lies: 1 stable, 0 not; undefined outside of the window.
  cellOfPoint() {
    if (!this.last) return undefined;
    const place = (value, [low, high]) => Math.round((value - low) / (high - low) * (this.last.count - 1));
    const i = place(this.gains[0], this.last.p), j = place(this.gains[1], this.last.d);
    const inside = i >= 0 && j >= 0 && i < this.last.count && j < this.last.count;
    return inside ? this.last.cells[i * this.last.count + j] : undefined;
  }

  /// With the cells, which lie behind it in the page.
  picture() {
    const {left, top, width, height} = this.cellBox;
    const image = this.under.append("image").attr("preserveAspectRatio", "none").attr("href", this.canvas.toDataURL())
      .attr("clip-path", this.plot.attr("clip-path"))
      .attr("x", left).attr("y", top).attr("width", width).attr("height", height);
    const text = standalone(this.svg.node());
    image.remove();
    return text;
  }

  saveNumbers() {
    if (!this.last) return;
    const {cells, count, p, d} = this.last;
    const at = ([low, high], k) => (low * (count - 1 - k) + high * k) / (count - 1);
    const rows = ["proportional_gain,differential_gain,stable"];
    for (let i = 0; i < count; ++i)
      for (let j = 0; j < count; ++j) rows.push(`${at(p, i)},${at(d, j)},${cells[i * count + j]}`);
    save("stability.csv", rows.join("\n") + "\n", "text/csv");
  }
}
