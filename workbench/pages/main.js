// The page: its screens, its files, its language.

import { app, get, Refused, sameKeys } from "./api.js";
import { showLine, showMessage, wireJobs } from "./jobs.js";
import { sayer } from "./said.js";
import { applyWords, currentLanguage, loadWords, setLanguage, t } from "./words.js";
import * as device from "./device.js";
import * as effects from "./effects.js";
import * as fails from "./fails.js";
import * as fall from "./fall.js";
import * as machine from "./machine.js";
import * as measurement from "./measurement.js";
import * as waves from "./waves.js";

const screens = { measurement, machine, fails, effects, fall, waves, device };
const element = (id) => document.getElementById(id);
const tabs = () => [...document.querySelectorAll("[role=tab]")];
let shown = "";

// Asks for the state of the folder; `choose` names files that are to be looked at from now on.
async function refresh(choose = {}) {
  Object.assign(app, choose);
  const state = await get("state");
  state.ledger = sameKeys(state.ledger);
  app.state = state;
  app.revision = state.revision;
  app.machine = state.machine?.name ?? "";
  if (!state.tables.includes(app.data)) app.data = state.ledger?.data && state.tables.includes(state.ledger.data) ? state.ledger.data : (state.tables[0] ?? "");
  options("choose-machine", state.machines, app.machine);
  options("choose-data", state.tables, app.data);
  const learned = (state.machine?.effects.length ?? 0) > 0 || state.ledger;
  element("tab-fails").disabled = element("tab-effects").disabled = !(app.machine && app.data);
  element("tab-fall").disabled = !learned && !(app.machine && app.data);
  element("tab-waves").disabled = element("tab-device").disabled = !app.machine;
  document.title = state.machine?.title ? `${state.machine.title} · helixlock` : "helixlock";
}

function options(id, names, chosen) {
  const made = names.map((name) => new Option(name, name, false, name === chosen));
  element(id).replaceChildren(...made);
  element(id).disabled = names.length === 0;
}

// What every screen may do beside its own: say something, look again, lead on.
const page = {
  refresh,
  show,
  // Does something for a button; what goes wrong is said.
  async attempt(act) {
    try {
      return await act();
    } catch (error) {
      if (error instanceof Refused && error.status === 409) {
        await refresh();
        await show(shown);
        showMessage(t("page.changed"), true);
      } else {
        const say = await sayer([error.message]).catch(() => (text) => text);
        showMessage(say(error.message), true);
      }
      return undefined;
    }
  },
};

async function show(name) {
  shown = name;
  sessionStorage.setItem("screen", name);
  for (const tab of tabs()) {
    const own = tab.id === `tab-${name}`;
    tab.setAttribute("aria-selected", own);
    tab.tabIndex = own ? 0 : -1;
    element(tab.getAttribute("aria-controls")).hidden = !own;
  }
  const root = element(name);
  root.replaceChildren();
  // A command is that of the screen it was begun on.
  showLine("");
  root.ariaBusy = "true";
  await page.attempt(() => screens[name].show(root, page));
  root.ariaBusy = "false";
}

function wireTabs() {
  for (const tab of tabs()) tab.addEventListener("click", () => show(tab.id.slice(4)));
  document.querySelector("[role=tablist]").addEventListener("keydown", (event) => {
    const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
    if (!step) return;
    const open = tabs().filter((tab) => !tab.disabled);
    const next = open[(open.indexOf(document.activeElement) + step + open.length) % open.length];
    next.focus();
    show(next.id.slice(4));
  });
}

function wireFiles() {
  const choose = (name) => (event) => page.attempt(async () => {
    await refresh({ [name]: event.target.value });
    await show(shown);
  });
  element("choose-machine").addEventListener("change", choose("machine"));
  element("choose-data").addEventListener("change", choose("data"));
  element("language").addEventListener("click", async () => {
    setLanguage(currentLanguage() === "en" ? "zh" : "en");
    label();
    await show(shown);
  });
}

function label() {
  applyWords();
  const other = currentLanguage() === "en" ? ["中文", "zh-Hans"] : ["English", "en"];
  element("language").textContent = other[0];
  element("language").lang = other[1];
}

await loadWords();
label();
wireTabs();
wireFiles();
wireJobs();
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => show(shown));
await page.attempt(() => refresh());
const wanted = sessionStorage.getItem("screen");
const first = app.data && app.machine ? "fails" : "measurement";
await show(wanted && !element(`tab-${wanted}`).disabled ? wanted : first);
document.documentElement.dataset.ready = "yes";
