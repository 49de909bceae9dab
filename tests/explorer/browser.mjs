// A headless Chromium with a page in it, driven through chromedriver (W3C WebDriver).
import {spawn} from "node:child_process";
import {mkdtempSync, rmSync} from "node:fs";
import {createServer} from "node:net";
import {tmpdir} from "node:os";
import {join} from "node:path";

const freePort = () => new Promise((resolve) => {
  const server = createServer().listen(0, "127.0.0.1", () => {
    const {port} = server.address();
    server.close(() => resolve(port));
  });
});

const quiet = ["--headless=new", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run",
  "--disable-background-networking", "--disable-component-update", "--disable-sync"];

export class Browser {
  /// @param size  of the window, [width, height]
  static async open({driver = "chromedriver", chromium, size = [1400, 1000], dark = false}) {
    const browser = new Browser();
    browser.port = await freePort();
    browser.profile = mkdtempSync(join(tmpdir(), "holdfast-browser-"));
    browser.downloads = mkdtempSync(join(tmpdir(), "holdfast-downloads-"));
    browser.driver = spawn(driver, [`--port=${browser.port}`, "--log-level=OFF"], {stdio: "ignore"});
    await browser.untilUp();
    const {sessionId} = await browser.send("POST", "/session", {capabilities: {alwaysMatch: {
      browserName: "chrome",
      "goog:loggingPrefs": {browser: "ALL", performance: "ALL"},
      "goog:chromeOptions": {binary: chromium,
        args: [...quiet, `--user-data-dir=${browser.profile}`, `--window-size=${size}`,
          ...(dark ? ["--force-dark-mode"] : [])],
        prefs: {"download.default_directory": browser.downloads, "download.prompt_for_download": false}},
    }}});
    browser.session = `/session/${sessionId}`;
    await browser.send("POST", `${browser.session}/timeouts`, {script: 120000, pageLoad: 60000});
    return browser;
  }

  async untilUp() {
    for (let tries = 0; tries < 200; ++tries) {
      try {
        if ((await this.send("GET", "/status")).ready) return;
      } catch { /* not yet */ }
      await new Promise((resolve) => setTimeout(resolve, 50));
    }
    throw new Error("chromedriver does not answer");
  }

  async send(method, path, body) {
    const answer = await fetch(`http://127.0.0.1:${this.port}${path}`,
      {method, body: body && JSON.stringify(body), headers: {"content-type": "application/json"}});
    const {value} = await answer.json();
    if (value?.error) throw new Error(`${value.error}: ${value.message}`);
    return value;
  }

  go(url) { return this.send("POST", `${this.session}/url`, {url}); }

  /// Runs a function in the page; its promise is waited for.
  run(code, ...args) {
    return this.send("POST", `${this.session}/execute/sync`, {script: `return (${code})(...arguments)`, args});
  }

  actions(actions) { return this.send("POST", `${this.session}/actions`, {actions}); }
  log(type) { return this.send("POST", `${this.session}/se/log`, {type}); }

  async close() {
    try {
      await this.send("DELETE", this.session);
    } finally {
      this.driver.kill();
      for (const folder of [this.profile, this.downloads])
        rmSync(folder, {recursive: true, force: true, maxRetries: 20, retryDelay: 100});
    }
  }
}
