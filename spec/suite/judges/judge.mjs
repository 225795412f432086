// The judge, for whoever embeds the files under vectors/ in tests of their own: judge(case, reply, hello) says what is wrong with
// a reply ({"result": ...} or {"reject": ...}) to a case, or null. `hello` holds features and limits, as in INTERPRETING.md.
//
// Not judged here: counters and registers, which are in no file, and tables (`hash/build`), where any right one will do. Look up
// every key of these.

export function judge(test, reply, { features = [], limits = {} } = {}) {
  const expect = isTooDeep(test, limits) ? { reject: "too-deep" } : test.expect;
  if (expect.reject) return reply.reject === expect.reject ? null : `expected the rejection '${expect.reject}'`;
  const found = reply.result;
  if (!found) return `expected an answer, not ${JSON.stringify(reply)}`;
  if (expect.near) return judgeNear(expect.near, found);
  if (expect.valid) return null;
  const ours = new Set(["counters", "registers"].filter((name) => features.includes(name)));
  for (const [name, value] of Object.entries(expect.result)) {
    ours.add(name);
    if (name === "trails" && !features.includes("trails")) ours.delete(name);
    else if (plain(name, value, features) !== plain(name, found[name], features)) return `${name} differs`;
  }
  const more = Object.keys(found).find((name) => !ours.has(name));
  return more ? `unknown field '${more}'` : null;
}

// Texts that are equal where values are: fields in order, zeros of either sign one, weights only where they are asked for.
function plain(name, value, features) {
  if (name !== "hits" || !Array.isArray(value)) return sorted(value);
  const weights = features.includes("weights") ? ["u", "v"] : [];
  const bits = (hit, field) => (hit[field] === "80000000" ? "00000000" : hit[field]);
  const isHit = (hit) => hit !== null && typeof hit === "object";
  return JSON.stringify(value.map((hit) => (isHit(hit) ? [hit.prim, ...["t", ...weights].map((f) => bits(hit, f))] : hit)));
}

const sorted = (value) =>
  JSON.stringify(value, (_, it) => (it && it.constructor === Object ? Object.fromEntries(Object.entries(it).sort()) : it));

function judgeNear({ ulps, hits }, { hits: found = [], ...more }) {
  const off = (a, b) => Math.abs(parseInt(a, 16) - parseInt(b, 16));
  const isNear = (hit, it) =>
    hit === null || it == null ? hit === it : hit.prims.includes(it.prim) && /^[0-9a-f]{8}$/.test(it.t) && off(hit.t, it.t) <= ulps;
  const at = hits.findIndex((hit, i) => !isNear(hit, found[i]));
  if (at >= 0 || found.length !== hits.length || Object.keys(more).length) return `hits[${at < 0 ? hits.length : at}] differs by more than ${ulps} ulp`;
  return null;
}

function isTooDeep({ id, input: { children, slots }, expect }, { max_depth: most, wide }) {
  if (!/^(trace|resume)\//.test(id) || expect.reject) return false;
  const limit = slots ? wide?.[slots] : most;
  const depth = (node) => Math.max(...children[node].map((child) => (children[child] ? 1 + depth(child) : slots ? 0 : 1)), 0);
  return limit !== undefined && children[0] !== null && depth(0) > limit;
}
