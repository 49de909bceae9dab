// How the explorer's page follows the hand: the point of the chart is dragged for some seconds.
//   node bench/explorer_drag.mjs PAGE.html [CHROMEDRIVER CHROMIUM]
// Prints the time to the first chart, frames a second, the longest frame, and how many charts of
// 200 x 200 cells and time histories of 2000 samples were computed and drawn a second meanwhile.
import {resolve} from "node:path";
import {pathToFileURL} from "node:url";
import {Browser} from "../tests/explorer/browser.mjs";

const [page, driver = "chromedriver", chromium = "/usr/bin/chromium"] = process.argv.slice(2);
const browser = await Browser.open({driver, chromium});
try {
  await browser.go("about:blank");
  await browser.go(pathToFileURL(resolve(page)).href);
  const first = await browser.run(`async () => {
    while (!globalThis.explorer?.chart?.last) await new Promise((done) => setTimeout(done, 5));
    return performance.now();
  }`);
  await new Promise((done) => setTimeout(done, 8000)); // until the answers are there
  const at = await browser.run(`() => {
    const counted = globalThis.counted = {frames: [], charts: 0, histories: 0};
    const frame = (time) => { counted.frames.push(time); requestAnimationFrame(frame); };
    requestAnimationFrame(frame);
    const count = (object, name, what) => {
      const own = object[name].bind(object);
      object[name] = (answer) => { ++counted[what]; own(answer); };
    };
    count(explorer.chart, "drawCells", "charts");
    count(explorer, "drawMotion", "histories");
    const box = document.querySelector("#chart .handle circle.dot").getBoundingClientRect();
    return [Math.round(box.x + box.width / 2), Math.round(box.y + box.height / 2)];
  }`);
  const moves = [];
  for (let k = 0; k < 300; ++k) {
    const x = Math.round(at[0] + 180 * Math.sin(k / 20)), y = Math.round(at[1] - 60 + 60 * Math.cos(k / 13));
    moves.push({type: "pointerMove", duration: 20, x, y});
  }
  await browser.actions([{type: "pointer", id: "hand", parameters: {pointerType: "mouse"}, actions: [
    {type: "pointerMove", duration: 0, x: at[0], y: at[1]}, {type: "pointerDown", button: 0}, ...moves,
    {type: "pointerUp", button: 0}]}]);
  const {frames, charts, histories} = await browser.run(`() => globalThis.counted`);
  const seconds = (frames[frames.length - 1] - frames[0]) / 1000;
  const longest = Math.max(...frames.slice(1).map((time, k) => time - frames[k]));
  console.log(`first chart ${first.toFixed(0)} ms after opening`);
  console.log(`${(frames.length / seconds).toFixed(1)} frames/s over ${seconds.toFixed(1)} s, the longest ${longest.toFixed(0)} ms`);
  console.log(`${(charts / seconds).toFixed(1)} charts/s, ${(histories / seconds).toFixed(1)} time histories/s`);
} finally {
  await browser.close();
}
