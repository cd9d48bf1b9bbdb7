// Long work: begun, watched, stopped; its command line is shown and can be copied.

import { app, get, post, sameKeys } from "./api.js";
import { t } from "./words.js";

const element = (id) => document.getElementById(id);
let current = null;
let begun = 0;
let stopped = false;

// The line of a machine file that is not saved does the same once it is.
export function showLine(line, unsaved = false) {
  element("line").textContent = line;
  element("command").hidden = !line;
  element("unsaved").hidden = !unsaved;
}

export function showMessage(text, bad = false) {
  element("message").textContent = text;
  element("message").classList.toggle("bad", bad);
}

export function wireJobs() {
  element("stop").addEventListener("click", () => {
    stopped = true;
    if (current) post("stop", { job: current });
  });
  element("copy").addEventListener("click", async () => {
    await navigator.clipboard.writeText(element("line").textContent);
    showMessage(t("page.copied"));
  });
}

const pause = (ms) => new Promise((done) => setTimeout(done, ms));

// Runs a command of the workbench; gives its number and what it printed, or nothing when it was
// stopped or other work was begun after it.
export async function run(command, words = {}, body = {}) {
  const turn = ++begun;
  const last = () => turn === begun;
  stopped = false;
  showMessage("");
  element("work").hidden = false;
  try {
    if (current) await post("stop", { job: current }).catch(() => {});
    let job = await post("begin", { command, ...words }, body);
    if (stopped || !last()) await post("stop", { job: job.job });
    if (!last()) return null;
    current = job.job;
    showLine(job.line, "text" in body && body.text !== app.state.machine.text);
    while (job.running && last()) {
      element("seconds").textContent = t("work.seconds", { n: job.seconds.toFixed(0) });
      // What is soon done is soon seen.
      await pause(Math.min(400, 40 + 100 * job.seconds));
      job = await get("job", { job: job.job });
    }
    // Work that gave way to other work needs no word.
    if (!last()) return null;
    if (job.error === "stopped") {
      if (stopped) showMessage(t("work.stopped"));
      return null;
    }
    if (job.error) throw new Error(job.error);
    const result = sameKeys(await get("result", { job: job.job }));
    return last() ? { job: job.job, seconds: job.seconds, result } : null;
  } finally {
    if (last()) {
      current = null;
      element("work").hidden = true;
    }
  }
}

// Runs a command beside what is shown, and says nothing of it; gives its number, or nothing where
// it has no answer.
export async function aside(command, words = {}) {
  let job = await post("begin", { command, ...words });
  while (job.running) {
    await pause(100);
    job = await get("job", { job: job.job });
  }
  return job.status === 0 ? job.job : null;
}
