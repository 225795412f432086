// Compares a page of `stackless explain` with the recording. This script runs in a copy of the page. It uses keyboard and mouse
// like a reader, reads only the document, and computes with numbers where the page uses digits.

(async () => {
  const data = JSON.parse(document.getElementById("data").textContent), find = (selector) => document.querySelector(selector);
  const all = (selector) => [...document.querySelectorAll(selector)], texts = (elements) => elements.map((element) => element.textContent);
  const key = data.keys.map((digits) => BigInt(`0b${digits}`)), label = (node) => key[node].toString(data.base);
  const B = BigInt(data.keyBits), A = data.trailBits;
  const nodeOf = (wanted) => key.indexOf(wanted), depth = (node) => (data.keys[node].length - 1) / data.keyBits;
  let checks = 0, where = "start";
  function same(what, found, expected) {
    checks++;
    const [a, b] = [found, expected].map((value) => JSON.stringify(value, (_, it) => typeof it === "bigint" ? String(it) : it) ?? "undefined");
    if (a !== b) throw new Error(`${where}: ${what}: shown ${a}, expected ${b}`);
  }
  const press = (pressed) => document.body.dispatchEvent(new KeyboardEvent("keydown", { key: pressed, bubbles: true, cancelable: true }));
  const value = (id) => find(`[data-value="${id}"]`)?.textContent;
  /** The cells of a row of bits, without its name and its sum. */
  const row = (name) => find(`tr[data-row="${name}"]`) && all(`tr[data-row="${name}"] td:not(.sum)`);
  const number = (cells) => BigInt(`0b${texts(cells).join("") || "0"}`);
  /** Names of the nodes of the tree that are drawn in one style. The name in the tooltip is never shortened. */
  const labelled = (kind) => texts(all(`#tree .node.${kind} title`)).map((title) => title.split(":")[0]).sort();
  const names = (nodes) => nodes.map(label).sort();

  function look(recording, at) {
    const step = recording.steps[at], { node, next } = step, own = key[node], deep = depth(node), beyond = step.beyond ?? [];
    const within = step.stack.filter((postponed) => !beyond.includes(postponed));
    where = `${recording.method}, visit ${at + 1}`;
    same("count", find("#count").textContent, `visit ${at + 1} of ${recording.steps.length}`);
    same("method", find("#method").value, recording.method);
    same("slider", find("#slider").value, String(at + 1));
    same("sentence", find("#text").textContent, step.text);
    same("clauses", texts(all("#clauses .clause")), step.clauses);
    same("present node", labelled("now"), names([node]));
    same("postponed nodes", labelled("wait"), names(within));
    const ancestors = Array.from({ length: deep }, (_, up) => nodeOf(own >> B * BigInt(up + 1)));
    same("path", labelled("path"), names(ancestors.filter((ancestor) => !within.includes(ancestor))));
    same("nodes that are beyond", beyond.every((node) => labelled("not").includes(label(node))), true);
    const done = new Set(recording.steps.slice(0, at).map((before) => before.node));
    [node, ...ancestors, ...step.stack].forEach((shown) => done.delete(shown));
    same("nodes that are done", labelled("seen"), names([...done]));
    same("edges of the path", all("#tree .edge.path").length, deep);
    same("key along the path", texts(all("#tree text.bit")).join(""), own.toString(2).slice(1));
    same("arrow", find("#arrow").style.display !== "none", next !== undefined && key[next.node] >> B !== own);

    same("levels", texts(row("level")), Array.from({ length: deep + 1 }, (_, level) => String(level)));
    same("path names", row("path").map((cell) => cell.title), [...ancestors.reverse(), node].map(label));
    for (const [name, digits, size] of [["key", step.key, data.keyBits], ["counter", step.counter, 1], ["trail", step.trail, A], ["sets", step.sets, A], ["disjoint", step.disjoint, 1]]) {
      const cells = row(name);
      same(`${name} is shown`, Boolean(cells), digits !== undefined);
      if (!digits) continue;
      same(name, number(cells), BigInt(`0b${digits}`));
      same(`${name}: columns`, cells.length, deep + 1);
      const first = name === "key" || name === "counter" ? 0 : 1;
      same(`${name}: digits of each level`, texts(cells).map((text) => text.length), cells.map((_, level) => level < first ? 0 : level ? size : 1));
      if (name === "disjoint") continue;
      const back = next?.levels;
      same(`${name}: levels that are left`, texts(cells).filter((_, i) => cells[i].classList.contains("gone")).length, back === undefined ? 0 : Math.min(back, deep));
      same(`${name}: bit that is toggled`, cells.findIndex((cell) => cell.classList.contains("turn")), back === undefined ? -1 : deep - back);
    }
    if (row("postponed")) {
      const shown = row("postponed").flatMap((cell) => cell.title.split(" ").filter(Boolean));
      if (A === 1 && !step.restart) same("postponed nodes by the word, and the oracle's", shown, step.stack.map(label));
      if (A > 1) same("pending nodes by the sets, and the oracle's", shown.filter((name) => !beyond.some((node) => label(node) === name)).sort(), names(within));
      if (A > 1) same("pending nodes at their levels", row("postponed").every((cell, level) => cell.title.split(" ").every((name) => !name || depth(nodeOf([...name].reduce((key, digit) => key * BigInt(data.base) + BigInt(digit), 0n))) === level)), true);
    }
    for (const [name, cells] of step.rows ?? []) same(name, texts(row(name)), ["", ...cells]);
    same("next key is shown", Boolean(row("next key")), Boolean(step.key && next));
    if (row("next key")) same("next key", [number(row("next key")), find('tr[data-row="next key"] .sum').textContent], [key[next.node], `= ${label(next.node)}`]);
    same("oracle's stack", texts(all("#stack li:not(.none)")), [...step.stack].reverse().map(label));
    same("oracle's next", texts(all("#stack li.next")), within.slice(-1).map(label));
    same("oracle's, beyond", texts(all("#stack li.beyond")).sort(), names(beyond));
    same("node", value("now"), label(node));
    const uncles = recording.links.includes("uncle");
    same("register", value("register"), uncles ? step.register === undefined ? "not set" : label(step.register) : undefined);
    recording.links.forEach((link, i) => same(link, value(`link-${i}`), step.links[i] === null ? "none" : label(step.links[i]) + (step.stack.includes(step.links[i]) ? ", postponed" : "")));
    if (step.decision) same("decision", value("decision"), step.decision);
    same("levels up", value("levels"), next?.levels === undefined ? undefined : String(next.levels));
    same("next node", value("next").split(/[,:]/)[0], next ? label(next.node) : "none");
    same("table is shown", find("#hash").hidden, !recording.table);
    if (recording.table) lookup(recording.table, next?.lookup);
    same("no wider than the window", document.documentElement.scrollWidth <= window.innerWidth, true);
  }

  function lookup(table, asked) {
    const text = find("#lookup").textContent, lit = texts(all("#tables .cell.hit"));
    if (!asked) return same("no lookup", [text.startsWith("No lookup"), lit], [true, []]);
    const k = BigInt(asked.number), [D, H] = [BigInt(table.displacements), BigInt(table.cells)], found = label(asked.node);
    same("bucket", [k % D, text.includes(`bucket ${k % D},`)], [BigInt(asked.bucket), true]);
    if (asked.entry.direct !== undefined) {
      same("direct address", text.includes(`address of ${found} itself`), true);
      if (table.buckets.length) same("table", lit, [`→${found}`]);
    } else {
      const d = BigInt(asked.entry.displacement), cell = ((k % H) + d) % H;
      same("cell", [cell, text.endsWith(`is cell ${cell}, which holds ${found}.`)], [BigInt(asked.cell), true]);
      if (table.buckets.length) same("table", lit, [`+${d}`, found]);
    }
  }

  /** The middle of an element, and whether a box is within the tree's view. */
  const middle = (element) => { const box = element.getBoundingClientRect(); return [(box.left + box.right) / 2, (box.top + box.bottom) / 2]; };
  const visible = (element) => {
    const [box, view] = [element.getBoundingClientRect(), find("#view").getBoundingClientRect()];
    return box.left > view.left - 1 && box.right < view.right + 1 && box.top > view.top - 1 && box.bottom < view.bottom + 1;
  };
  /** All nodes are in the view, without scrolling. */
  function whole(when) {
    const view = find("#view");
    same(`the whole tree is in view, ${when}`, [view.scrollWidth <= view.clientWidth + 1, view.scrollHeight <= view.clientHeight + 1, all("#tree .node").every(visible)], [true, true, true]);
  }
  /** The node and the next postponed node are in view and readable. */
  function inView(recording, at) {
    const { node, stack, beyond = [], next } = recording.steps[at], top = stack.filter((it) => !beyond.includes(it)).at(-1);
    where = `${recording.method}, visit ${at + 1}`;
    const those = [node, top, next?.levels === undefined ? undefined : next.node].filter((it) => it !== undefined).map((it) => find(`#tree [data-node="${it}"]`));
    same("both nodes are in view", those.map(visible), those.map(() => true));
    const text = those.map((it) => it.querySelector("text"));
    same("both nodes can be read", text.every((it) => getComputedStyle(it).visibility === "visible" && it.getBoundingClientRect().height >= 10), true);
  }

  /** Zooms by buttons, keys and wheel: the tree grows, and is whole again afterwards. */
  function sizes(recording, last, stride) {
    const width = () => find("#tree").getBoundingClientRect().width, small = width();
    where = `${recording.method}, sizes`;
    whole("before it is made larger");
    const wheel = (deltaY) => find("#view").dispatchEvent(new WheelEvent("wheel", { deltaY, ctrlKey: true, bubbles: true, cancelable: true, clientX: 99, clientY: 99 }));
    const ways = { key: [() => press("+"), () => press("-")], button: [() => find("#larger").click(), () => find("#smaller").click()], wheel: [() => wheel(-120), () => wheel(120)] };
    for (const [name, [larger, smaller]] of Object.entries(ways)) {
      larger();
      const grown = width();
      same(`larger by ${name}`, grown > small * 1.1, true);
      larger(); smaller(); smaller();
      same(`smaller by ${name}`, Math.abs(width() - small) < 2, true);
    }
    // At the greatest size both nodes are still in view. The size returns to the greatest where they are close to each other.
    for (let i = 0; i < 12; i++) press("+");
    const most = width();
    same("the greatest size can be read", find("#tree").classList.contains("small"), false);
    for (let at = 0; at <= last; at += stride) { inView(recording, at); for (let i = 0; i < stride; i++) press("ArrowRight"); }
    press("Home");
    inView(recording, 0);
    same("it is as large again", Math.abs(width() - most) < 2, true);
    press("0");
    same("the whole again", Math.abs(width() - small) < 2, true);
    whole("at the end");
  }

  /** Each chip is a link: a click and its address both show the clause. */
  async function clauses(recording, wait) {
    where = `${recording.method}, clauses`;
    const shown = find("#clause");
    for (let i = 0; i < all("a.clause").length; i++) {
      const chip = all("a.clause")[i], id = chip.textContent, clause = data.clauses[id];
      chip.click();
      const words = (text) => text.replace(/[`*\[\]()]/g, "").split(/\s+/).slice(0, 6);
      same(`${id} is open`, shown.matches(":popover-open"), true);
      same(`${id} is that clause`, [shown.querySelector("h3").textContent, shown.textContent.includes(clause.file)], [`${id}: ${clause.title}`, true]);
      same(`${id} has its text`, words(shown.querySelector("p").textContent), words(clause.text));
      shown.hidePopover();
      location.hash = new URL(all("a.clause")[i].href).hash;
      await wait(30);
      same(`${id} by its address`, [shown.matches(":popover-open"), shown.querySelector("h3").textContent.split(":")[0]], [true, id]);
      shown.hidePopover();
    }
  }

  async function run() {
    const wait = (time) => new Promise((done) => setTimeout(done, time));
    same("title", [document.title, find("h1").textContent], [data.title, data.title]);
    const places = data.keys.map((_, node) => middle(find(`#tree [data-node="${node}"]`)));
    // A level whose number has no room has a line too, which is not shown.
    const lines = all("#tree line.level").map((line) => Number(line.getAttribute("y1"))), above = find("#tree").getBoundingClientRect().top;
    same("a line for each level", lines.length, 1 + Math.max(...data.keys.map((_, node) => depth(node))));
    same("nodes stand at their levels", places.every(([, y], node) => Math.abs(y - above - lines[depth(node)]) < 1), true);
    whole("at first");
    same("every control has a name", all("button, select, input").filter((it) => !it.textContent && !it.ariaLabel && !it.labels?.length).length, 0);
    for (const [i, recording] of data.methods.entries()) {
      const last = recording.steps.length - 1;
      if (i < 9) press(String(i + 1));
      else { find("#method").value = recording.method; find("#method").dispatchEvent(new Event("change")); }
      press("Home");
      // Checking every visit is slow for thousands of nodes and hundreds of visits.
      const stride = data.keys.length * last > 50000 ? 13 : 1;
      for (let at = 0; at <= last; at++) { inView(recording, at); if (at % stride === 0) look(recording, at); press("ArrowRight"); }
      for (let at = last; at >= 0; at--) { inView(recording, at); if (at % stride === 0) look(recording, at); press("ArrowLeft"); }
      sizes(recording, last, stride);
      await clauses(recording, wait);
      press("End"); look(recording, last);
      press("Home"); look(recording, 0);
      for (const [id, at] of [["last", last], ["back", Math.max(last - 1, 0)], ["forth", last], ["first", 0]]) { find(`#${id}`).click(); look(recording, at); }
      find("#slider").value = last + 1; find("#slider").dispatchEvent(new Event("input")); look(recording, last);
      location.hash = `#method=${recording.method}&step=${Math.min(2, last + 1)}`;
      await wait(50); look(recording, Math.min(1, last));
      press("Home");
      await wait(300); same("link", location.hash, `#method=${recording.method}&step=1`);
    }
    const recording = data.methods.at(-1), last = recording.steps.length - 1;
    press("Home"); press(" ");
    await wait(1300); look(recording, Math.min(1, last));
    same("playing", find("#play").textContent, last > 1 ? "Pause" : find("#play").textContent);
    if (find("#play").textContent === "Pause") press(" ");
    await wait(3000); look(recording, Math.min(1, last));
    location.hash = "#method=nosuch&step=99999"; await wait(50); look(recording, last);
    location.hash = "#step=-3"; await wait(50); look(recording, 0);
    where = "the end";
    same("faults", window.faults, []);
  }

  let result;
  try { await run(); result = `passed ${checks} checks`; } catch (error) { result = `failed: ${error.message}`; }
  window.parent.postMessage(`${window.name}: ${result}`, "*");
})();
