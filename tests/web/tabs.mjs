// A browser whose background tabs are hidden, as in normal use; Playwright's tabs never are. It is
// controlled through a pipe with the DevTools protocol.
import { spawn } from "node:child_process";
import { once } from "node:events";
import { mkdtemp, rm } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { chromiumPath, renderer } from "./browser.mjs";

/**
 * @returns {evaluate, leave, comeBack, close} for a tab that shows the address; leave opens
 *   another tab in front of it
 */
export async function openTab(address) {
  const profile = await mkdtemp(join(tmpdir(), "substep-tabs-"));
  const browser = spawn(chromiumPath(), ["--headless=new", "--remote-debugging-pipe", `--user-data-dir=${profile}`,
    ...renderer], { stdio: ["ignore", "ignore", "ignore", "pipe", "pipe"] });
  const [, , , input, output] = browser.stdio;
  const waiting = new Map(); // by number of the call
  let heard = "";
  output.setEncoding("utf8").on("data", (text) => {
    const messages = (heard + text).split("\0");
    heard = messages.pop();
    for (const { id, result, error } of messages.map((message) => JSON.parse(message))) {
      waiting.get(id)?.(error ? Promise.reject(new Error(error.message)) : result);
      waiting.delete(id);
    }
  });
  let calls = 0;
  const send = (method, params = {}, sessionId = undefined) => new Promise((answer) => {
    waiting.set(++calls, answer);
    input.write(`${JSON.stringify({ id: calls, method, params, sessionId })}\0`);
  });

  const { targetId } = await send("Target.createTarget", { url: "about:blank" });
  const { sessionId } = await send("Target.attachToTarget", { targetId, flatten: true });
  await send("Page.navigate", { url: address }, sessionId);
  return {
    /** @param expression may be a promise @returns its value */
    async evaluate(expression) {
      const { result, exceptionDetails } = await send("Runtime.evaluate",
        { expression, awaitPromise: true, returnByValue: true }, sessionId);
      if (exceptionDetails) throw new Error(exceptionDetails.exception?.description ?? exceptionDetails.text);
      return result.value;
    },
    leave: () => send("Target.createTarget", { url: "about:blank" }),
    comeBack: () => send("Target.activateTarget", { targetId }),
    async close() {
      const ended = once(browser, "exit");
      send("Browser.close");
      await ended;
      await rm(profile, { recursive: true, maxRetries: 5 });
    },
  };
}
