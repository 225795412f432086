// Compares the page in the browser with the answers of the native library. This script runs in a copy of the page. It uses
// only the elements of the document, like a reader, and reads colours from the canvases.

(async () => {
  const $ = (id) => document.getElementById(id), answers = window.answers, SIDE = 512;
  // On a page with a planted mistake, do not wait long for a missing result.
  const patience = window.name.startsWith("bad-") ? 4 : 20;
  let checks = 0, where = "start";
  function same(what, found, expected) {
    checks++;
    const [a, b] = [found, expected].map((value) => JSON.stringify(value));
    if (a !== b) throw new Error(`${where}: ${what}: found ${a}, expected ${b}`);
  }
  async function until(what, is, seconds = patience) {
    for (let left = seconds * 50; !is(); left--) {
      if (!left) throw new Error(`${where}: ${what} has not come; the status is "${$("status").textContent}", the error "${$("error").textContent}"`);
      await new Promise((done) => setTimeout(done, 20));
    }
  }
  const traced = () => until("the picture", () => $("status").textContent.endsWith(", traced"), 90);
  const pixels = (id) => $(id).getContext("2d").getImageData(0, 0, SIDE, SIDE).data;
  /** Hashes a picture like wasm/answers.rs. */
  function digest(bytes) {
    let sum = 0x811c9dc5;
    for (const byte of bytes) sum = Math.imul(sum ^ byte, 0x01000193);
    return (sum >>> 0).toString(16).padStart(8, "0");
  }

  /** Checks everything that the page shows of a traced scene; returns the lost pixels. */
  function look(name) {
    where = name;
    const { totals, pictures } = answers[name], { hits, lost, ghosts, other, digests } = totals;
    same("bits of all answers", $("digests").textContent, `${digests[0]} exact, ${digests[1]} inexact`);
    const exact = pixels("exact"), inexact = pixels("inexact"), marks = pixels("marks");
    same("pictures", [digest(exact), digest(inexact)], pictures);
    const shown = ["hits", "lost", "ghosts", "other"].map((id) => Number($(id).textContent.replaceAll(",", "")));
    same("counts", shown, [hits, lost, ghosts, other]);
    const red = (at) => marks[at + 3] === 255 && marks[at] > 200 && marks[at + 1] < 60, gone = [];
    let [count, wrong] = [0, 0];
    for (let at = 0; at < marks.length; at += 4) {
      count += red(at);
      if (exact[at + 3] === inexact[at + 3]) continue;
      same(`pixel ${at / 4} is marked`, red(at), true);
      wrong++;
      if (exact[at + 3]) gone.push(at / 4);
    }
    same("pixels that are lost or ghosts", [wrong, gone.length], [lost + ghosts, lost]);
    same("marks", [count > 0, count <= 25 * (lost + ghosts + other)], [lost + ghosts + other > 0, true]);
    same("error", $("error").hidden, true);
    same("no wider than the window", document.documentElement.scrollWidth <= window.innerWidth, true);
    return gone;
  }

  /** The middle of a pixel, in the window. Browsers round clicks to whole numbers, so some pixels of a small picture cannot be hit. */
  function middle(at) {
    const box = $("inexact").getBoundingClientRect(), place = (i) => (i + 0.5) / SIDE;
    return [box.left + box.width * place(at % SIDE), box.top + box.height * place(Math.floor(at / SIDE))].map(Math.floor);
  }
  function canBeHit(at) {
    const box = $("inexact").getBoundingClientRect(), [x, y] = middle(at), place = (part) => Math.floor(part * SIDE);
    return place((x - box.left) / box.width) === at % SIDE && place((y - box.top) / box.height) === Math.floor(at / SIDE);
  }
  function click(at) {
    const [clientX, clientY] = middle(at);
    $("inexact").dispatchEvent(new MouseEvent("click", { clientX, clientY, bubbles: true }));
  }
  const page = () => $("steps").contentDocument;

  /** Clicks a pixel, and checks its explanation and its steps. */
  async function steps(at, kind) {
    const before = page();
    click(at);
    const title = `Pixel ${at % SIDE}, ${Math.floor(at / SIDE)}: ${kind}`;
    await until(title, () => $("where").textContent === title && page() !== before && page()?.querySelector("#count")?.textContent);
    const count = () => page().querySelector("#count").textContent, visits = Number(count().match(/^visit 1 of (\d+)$/)?.[1]);
    same("title of the steps", page().title.endsWith(`, pixel ${at % SIDE},${Math.floor(at / SIDE)}`), true);
    same("there are steps", visits > 1, true);
    page().querySelector("#forth").click();
    same("second step", count(), `visit 2 of ${visits}`);
    same("the loupe", [...$("loupe-exact").getContext("2d").getImageData(5, 5, 1, 1).data], [...pixels("exact").slice(4 * at, 4 * at + 4)]);
  }

  function drop(name, ...parts) {
    const dataTransfer = new DataTransfer();
    dataTransfer.items.add(new File(parts, name));
    document.dispatchEvent(new DragEvent("drop", { dataTransfer, cancelable: true }));
  }
  function chooseFile(name, ...parts) {
    const files = new DataTransfer();
    files.items.add(new File(parts, name));
    $("file").files = files.files;
    $("file").dispatchEvent(new Event("change"));
  }
  async function refused(name, parts, ...expected) {
    where = name;
    drop(name, ...parts);
    await until("an error", () => !$("error").hidden && $("error").textContent.startsWith(name));
    for (const part of expected) if (!$("error").textContent.includes(part)) same("error", $("error").textContent, part);
    same("nothing goes on", [$("progress").hidden, $("chosen").hidden, $("hits").textContent], [true, true, "–"]);
  }
  /** A file that promises vertices and has none. */
  const ply = (count) => `ply\nformat binary_little_endian 1.0\nelement vertex ${count}\nproperty float x\nproperty float y\nproperty float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n`;
  const example = (name) => { $("example").value = name; $("example").dispatchEvent(new Event("change")); };

  async function run() {
    await traced();
    const lost = look("corners"), at = lost.find((at) => at % SIDE > 300 && at > 100 * SIDE && at < 200 * SIDE && canBeHit(at));
    await steps(at, "the hit is lost");
    same("both answers", [/^Exact: triangle \d+ at distance [\d.]+\.$/.test($("answer-exact").textContent), $("answer-inexact").textContent], [true, "Inexact: nothing is hit."]);
    $("next").click();
    await until("the next wrong pixel", () => $("where").textContent.startsWith("Pixel") && !$("where").textContent.startsWith(`Pixel ${at % SIDE}, `));
    same("it is wrong", /lost|ghost|another/.test($("where").textContent), true);
    await refused("bad.obj", ["v 0 0 0\nv 1 0 0\nv 0 1\nf 1 2 3\n"], "line 3");
    await refused("bad.xyz", ["1 2 3"], "expected .ply, .obj, .stl, .gltf or .glb");
    await refused("none.obj", ["v 0 0 0\n"], "no triangles");
    await refused("many.ply", [ply(4000000000)], "line 3", "a count up to 2147483647");
    await refused("cut.ply", [ply(2000000000)], "vertex 0 (of 2000000000)", "the file ends");
    await refused("large.ply", [new Uint8Array((64 << 20) + 1)], "at most 67,108,864");
    drop("room.obj", window.room);
    await traced();
    look("room.obj");
    await steps([300, 301, 302, 303].flatMap((x) => [256, 257, 258, 259].map((y) => y * SIDE + x)).find(canBeHit), "both tracers agree");
    example("torus");
    await until("another scene", () => $("status").textContent.startsWith("torus"));
    await traced();
    look("torus");
    chooseFile("again.obj", window.room);
    await until("the file", () => $("status").textContent.startsWith("again.obj"));
    await traced();
    same("the same file, chosen", $("digests").textContent, `${answers["room.obj"].totals.digests[0]} exact, ${answers["room.obj"].totals.digests[1]} inexact`);
    example("strands");
    $("stop").click();
    same("stopped", [$("status").textContent.startsWith("Stopped"), $("progress").hidden], [true, true]);
    where = "the end";
    same("faults", window.faults, []);
  }

  let result;
  try { await run(); result = `passed ${checks} checks`; } catch (error) { result = `failed: ${error.message}`; }
  window.parent.postMessage(`${window.name}: ${result}`, "*");
})();
