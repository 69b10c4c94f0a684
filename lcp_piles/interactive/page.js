"use strict";
(() => {
  const data = JSON.parse(document.getElementById("data").textContent);
  const $ = (id) => document.getElementById(id);
  const { discs, contacts, base, start, path, bounds, texts } = data;
  const STEPS = 8; // places of the slider on every piece of the path
  const pieces = path ? path.changes.length - 1 : 0;
  const SVG = "http://www.w3.org/2000/svg";

  // ---- numbers -------------------------------------------------------------------------------
  function unpack(series) {
    const bytes = Uint8Array.from(atob(series.rows), (c) => c.charCodeAt(0));
    series.floats = new Float32Array(bytes.buffer);
  }
  Object.values(start).forEach(unpack);
  if (path) ["push", "force", "gap", "shift", "base"].forEach((name) => unpack(path[name]));

  // A sum of rational multiples of roots: a map from radicand to [numerator, denominator].
  function read(text) {
    const terms = new Map();
    for (const [, sign, p, q, root] of text.matchAll(/([+-]?) ?(?:(\d+)(?:\/(\d+))?)?\*?(?:sqrt\((\d+)\))?/g)) {
      if (p || root) {
        const n = BigInt(p || 1);
        terms.set(root || "1", [sign === "-" ? -n : n, BigInt(q || 1)]);
      }
    }
    return terms;
  }
  const divisor = (a, b) => { while (b) [a, b] = [b, a % b]; return a < 0n ? -a : a; };
  function between(one, two, j) { // ((STEPS - j) one + j two) / STEPS, exactly
    const sum = new Map();
    for (const [text, weight] of [[one, STEPS - j], [two, j]]) {
      for (const [root, [n, d]] of read(text)) {
        const [m, e] = sum.get(root) || [0n, 1n];
        sum.set(root, [m * d + n * BigInt(weight) * e, e * d]);
      }
    }
    let out = "";
    for (const root of [...sum.keys()].sort((x, y) => Number(x) - Number(y))) {
      let [n, d] = sum.get(root);
      d *= BigInt(STEPS);
      if (n === 0n) continue;
      const g = divisor(n, d), size = (n < 0n ? -n : n) / g;
      d /= g;
      let term = d === 1n ? `${size}` : `${size}/${d}`;
      if (root !== "1") term = term === "1" ? `sqrt(${root})` : `${term}*sqrt(${root})`;
      out += out ? (n < 0n ? " - " : " + ") + term : (n < 0n ? "-" : "") + term;
    }
    return out || "0";
  }

  // ---- where on the path we are: a piece and a step on it -------------------------------------
  let position = 0;
  const place = () => {
    const piece = Math.min(Math.floor(position / STEPS), pieces - 1);
    return [piece, position - STEPS * piece];
  };
  const columns = (name, piece) => (name === "force" || name === "base" || name === "push" ? [piece, piece + 1] : [2 * piece, 2 * piece + 1]);
  const entry = (series, k, column) => series.floats[series.of[k] * series.columns + column];
  function float(name, k) {
    if (position === 0) return entry(name === "push" ? path.push : start[name], k, 0);
    const [piece, j] = place(), [c, d] = columns(name, piece), series = path[name];
    if (series.columns <= d) return NaN;
    return j === 0 ? entry(series, k, c) : j === STEPS ? entry(series, k, d)
      : ((STEPS - j) * entry(series, k, c) + j * entry(series, k, d)) / STEPS;
  }
  function exact(name, k) { // null where the text is not kept
    if (position === 0 && name !== "push") return texts[start[name].text[0][k]];
    const [piece, j] = place(), [c, d] = columns(name, piece);
    const at = (column) => texts[name === "push" ? path.push.text[0][column] : path[name].text[column][k]];
    if (name !== "push" && piece >= path.whole) return null;
    if (j === 0) return at(c);
    return j === STEPS ? at(d) : between(at(c), at(d), j);
  }
  const zero = (name, k) => columns(name, place()[0]).every((c) => entry(path[name], k, c) === 0); // so exactly
  const pushNow = () => { const [piece, j] = place(); const [a, b] = [path.push.floats[piece], path.push.floats[piece + 1]]; return ((STEPS - j) * a + j * b) / STEPS; };

  function stateOf(k) {
    if (float("force", k) !== 0) return "closed";
    return float("gap", k) !== 0 ? "open" : "osculatory";
  }

  // ---- drawing -------------------------------------------------------------------------------
  function node(parent, tag, attributes, cls) {
    const made = document.createElementNS(SVG, tag);
    for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
    if (cls) made.setAttribute("class", cls);
    parent.appendChild(made);
    return made;
  }
  const mean = discs.reduce((sum, d) => sum + d[3], 0) / discs.length;
  const X = (d) => d[1] / mean, Y = (d) => -d[2] / mean, R = (d) => d[3] / mean;
  const segment = contacts.map(([, a, b, nx, ny]) => {
    const from = discs[a], r = R(from);
    const to = b < 0 ? [X(from) - r * nx, Y(from) + r * ny] : [X(discs[b]), Y(discs[b])];
    return [X(from), Y(from), ...to];
  });
  const low = [1e9, 1e9], high = [-1e9, -1e9];
  for (const d of discs) [X(d), Y(d)].forEach((v, i) => {
    low[i] = Math.min(low[i], v - R(d)); high[i] = Math.max(high[i], v + R(d));
  });
  const wide = high[0] - low[0] + 1.6;
  const pile = $("pile");
  pile.setAttribute("viewBox", `${low[0] - 0.8} ${low[1] - 0.7} ${wide} ${high[1] - low[1] + 1.4}`);
  // As wide as fits the height of the window; the bars below have the same width, to be in line.
  [pile, $("base")].forEach((svg) => { svg.style.maxWidth = `${54 * wide / (high[1] - low[1] + 1.4)}vh`; });
  const layer = () => node(pile, "g", {});
  const [discLayer, hitLayer, lineLayer, grounds, axisLayer] = [0, 1, 2, 3, 4].map(layer);
  const seen = new Set();
  contacts.forEach(([, , b, nx, ny], k) => {
    const key = `${b} ${nx} ${ny}`;
    if (b >= 0 || seen.has(key)) return;
    seen.add(key);
    const [, , x, y] = segment[k], along = [ny, nx];
    const reach = discs.map((d) => (X(d) - x) * along[0] + (Y(d) - y) * along[1]);
    const [s, e] = [Math.min(...reach) - 1.2, Math.max(...reach) + 1.2];
    const point = (t, down) => `${x + t * along[0] - down * nx},${y + t * along[1] + down * ny}`;
    node(grounds, "polygon", { points: [point(s, 0), point(e, 0), point(e, 0.45), point(s, 0.45)].join(" ") }, "ground");
    node(grounds, "line", { x1: x + s * along[0], y1: y + s * along[1], x2: x + e * along[0], y2: y + e * along[1] }, "surface");
  });
  const focusable = { tabindex: -1, role: "img" };
  const discNodes = discs.map((d) => node(discLayer, "circle", { cx: X(d), cy: Y(d), r: R(d), ...focusable }, d[4] ? "disc held" : "disc"));
  const ends = ([x1, y1, x2, y2]) => ({ x1, y1, x2, y2 });
  const hitNodes = segment.map((s) => node(hitLayer, "line", { ...ends(s), ...focusable }, "hit"));
  const lineNodes = segment.map((s) => node(lineLayer, "line", ends(s), "contact"));

  const baseSvg = $("base"), TALL = Math.min(6, 0.22 * wide);
  baseSvg.setAttribute("viewBox", `${low[0] - 0.8} 0 ${wide} ${TALL}`);
  const barNodes = base.map(([disc]) => node(baseSvg, "rect", { x: X(discs[disc]) - 0.7, width: 1.4, ...focusable }, "bar"));
  const placeNodes = base.map(([disc]) => node(baseSvg, "rect", { x: X(discs[disc]) - 1, width: 2, y: 0, height: TALL }, "place"));
  node(baseSvg, "line", { x1: low[0] - 0.8, x2: high[0] + 0.8, y1: TALL, y2: TALL }, "surface");
  $("pressed").hidden = base.length === 0;

  function draw() {
    const forces = contacts.map((_, k) => Math.abs(float("force", k)));
    const loaded = forces.filter((f) => f > 0).sort((a, b) => a - b);
    const strongest = loaded[loaded.length - 1] || 1, how = $("width").value;
    const half = loaded.length >> 1;
    const median = loaded.length % 2 ? loaded[half] : (loaded[half - 1] + loaded[half]) / 2;
    const largest = how === "clip" ? Math.min(strongest, 10 * median || strongest) : strongest;
    const share = (f) => (how === "log" ? Math.log1p(f) / Math.log1p(largest) : Math.min(f / largest, 1));
    lineNodes.forEach((line, k) => {
      const state = stateOf(k), tension = float("force", k) < 0;
      line.setAttribute("class", `contact ${state}${tension ? " tension" : ""}`);
      if (state === "closed") line.setAttribute("stroke-width", Math.max(0.62 * share(forces[k]), 0.035).toFixed(3));
      else line.removeAttribute("stroke-width");
    });
    pile.classList.toggle("bare", !$("absent").checked);
    pile.classList.toggle("pale", $("axes").checked);
    const pressed = base.map((_, k) => float("base", k)), top = Math.max(...pressed, 0);
    barNodes.forEach((bar, k) => {
      const tall = top > 0 ? Math.max(pressed[k], 0) / top * (TALL - 0.3) : 0;
      bar.setAttribute("y", TALL - tall);
      bar.setAttribute("height", tall);
    });
    $("highest").textContent = `the highest bar is ${near(top)}`;
    drawAxes();
    legend(largest, strongest);
    if (path) tell();
  }

  function stress(k) { // pi R sigma of a disc: minus the sum of f n n
    let [xx, xy, yy] = [0, 0, 0];
    touching[k].forEach((c) => {
      const f = float("force", c), [, , , nx, ny] = contacts[c];
      xx -= f * nx * nx; xy -= f * nx * ny; yy -= f * ny * ny;
    });
    const scale = Math.PI * discs[k][3], middle = (xx + yy) / 2 / scale;
    const radius = Math.hypot((xx - yy) / 2, xy) / scale;
    const angle = Math.atan2(-2 * xy, yy - xx) / 2;
    return { major: middle - radius, minor: middle + radius, angle, isotropic: radius === 0 };
  }
  const touching = discs.map(() => []);
  contacts.forEach(([, a, b], k) => { touching[a].push(k); if (b >= 0) touching[b].push(k); });
  function drawAxes() {
    axisLayer.replaceChildren();
    if (!$("axes").checked) return;
    const all = discs.map((d, k) => (d[4] ? null : stress(k)));
    const most = Math.max(...all.map((s) => (s ? Math.max(Math.abs(s.major), Math.abs(s.minor)) : 0)));
    all.forEach((s, k) => {
      if (!s || !most) return;
      [[s.major, s.angle], [s.minor, s.angle + Math.PI / 2]].forEach(([size, angle]) => {
        const l = 0.95 * R(discs[k]) * Math.abs(size) / most;
        const [dx, dy] = [l * Math.cos(angle), -l * Math.sin(angle)], x = X(discs[k]), y = Y(discs[k]);
        node(axisLayer, "line", { x1: x - dx, y1: y - dy, x2: x + dx, y2: y + dy }, size > 0 ? "axis tension" : "axis");
      });
    });
  }

  function legend(largest, strongest) {
    const box = $("legend");
    box.replaceChildren();
    const item = (cls, text, width) => {
      const li = document.createElement("li"), svg = node(li, "svg", { viewBox: "0 0 3.2 1", "aria-hidden": true });
      const line = node(svg, "line", { x1: 0.3, x2: 2.9, y1: 0.5, y2: 0.5 }, cls);
      if (width) line.setAttribute("stroke-width", width);
      li.append(text);
      box.append(li);
    };
    item("contact", `force ${near(largest)} w` + (largest < strongest ? ` to ${near(strongest)} w` : ""), 0.62);
    if ([...lineNodes].some((n) => n.classList.contains("tension"))) item("contact tension", "tension", 0.3);
    if ($("absent").checked) {
      item("contact open", "open: no contact");
      item("contact osculatory", "osculatory: touches, no force");
    }
    if ($("axes").checked) item("axis", "principal stress (pressure)");
  }

  // ---- words ---------------------------------------------------------------------------------
  const near = (x) => (Number.isFinite(x) ? String(Number(x.toPrecision(6))) : "not kept");
  const shortly = (text, x, unit) => (/^-?\d{1,12}$/.test(text) || !data.exact ? text + unit : `${text}${unit} (about ${near(x)})`);
  function value(name, k, unit) {
    const text = exact(name, k), x = float(name, k);
    if (text === null && name !== "shift" && zero(name, k)) return `0 ${unit}`;
    if (text === null) return Number.isNaN(x) ? "not kept for this push" : `about ${near(x)} ${unit}; the exact number is too long to be kept`;
    return shortly(text, x, ` ${unit}`);
  }
  function contactRows(k) {
    const rows = [["contact", contacts[k][0]], ["state", stateOf(k)], ["force", value("force", k, "w")], ["gap", value("gap", k, "w tau")]];
    if (bounds) rows.push([`with friction ${bounds.mu}${position ? ", at the start" : ""}`, `from ${texts[bounds.least[k]]} to ${texts[bounds.largest[k]]}`]);
    return rows;
  }
  function discRows(k) {
    const rows = [["disc", discs[k][0]], ["displacement x", value("shift", 2 * k, "w tau")], ["displacement y", value("shift", 2 * k + 1, "w tau")]];
    if (discs[k][4]) rows.push(["motion", "prescribed"]);
    else {
      const s = stress(k), degrees = s.isotropic ? "" : `, major axis at ${near(s.angle * 180 / Math.PI)} degrees`;
      rows.push(["stress", `principal values ${near(s.major)} and ${near(s.minor)} w/R${degrees}`]);
    }
    const at = base.findIndex(([disc]) => disc === k);
    if (at >= 0) rows.push(["on the base", value("base", at, "w")]);
    return rows;
  }
  const barRows = (k) => [["force on the base", value("base", k, "w")], ["of disc", discs[base[k][0]][0]]];
  const groups = {
    contact: { nodes: hitNodes, rows: contactRows, at: (k) => [(segment[k][0] + segment[k][2]) / 2, (segment[k][1] + segment[k][3]) / 2] },
    disc: { nodes: discNodes, rows: discRows, at: (k) => [X(discs[k]), Y(discs[k])] },
    bar: { nodes: barNodes, rows: barRows, at: (k) => [X(discs[base[k][0]]), 0] },
  };
  function linked(kind, k) { // what belongs together: a disc of the base, its bar, what carries it
    const at = kind === "bar" ? k : kind === "disc" ? base.findIndex(([disc]) => disc === k) : base.findIndex(([, parts]) => parts.some(([c]) => c === k));
    if (at < 0) return [];
    return [barNodes[at], discNodes[base[at][0]], ...base[at][1].map(([c]) => hitNodes[c])];
  }
  let focused = null, shown = null;
  const sentence = (rows) => rows.map(([name, text]) => `${name} ${text}`).join(", ");
  function show(item) {
    document.querySelectorAll(".now, .linked").forEach((n) => n.classList.remove("now", "linked"));
    shown = item;
    if (!item) return;
    const [kind, k] = item, group = groups[kind], rows = group.rows(k);
    linked(kind, k).forEach((n) => n.classList.add("linked"));
    group.nodes[k].classList.add("now");
    group.nodes[k].setAttribute("aria-label", sentence(rows));
    const list = document.createElement("dl");
    for (const [name, text] of rows) {
      const dt = document.createElement("dt"), dd = document.createElement("dd");
      dt.textContent = name;
      dd.textContent = text;
      list.append(dt, dd);
    }
    $("details").replaceChildren(list);
  }
  function go(kind, k) {
    const { nodes } = groups[kind];
    nodes.forEach((n) => n.getAttribute("tabindex") === "0" && n.setAttribute("tabindex", -1));
    nodes[k].setAttribute("tabindex", 0);
    show([kind, k]); // the label is there before the focus is
    nodes[k].focus({ preventScroll: kind !== "bar" });
  }
  const WAYS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
  function nearest(kind, from, way, but) {
    const { nodes, at } = groups[kind];
    let best = -1, least = Infinity;
    nodes.forEach((_, k) => {
      if (k === but) return;
      const [x, y] = at(k), [dx, dy] = [x - from[0], y - from[1]];
      const ahead = way ? dx * way[0] + dy * way[1] : 0, aside = way ? Math.abs(dx * way[1]) + Math.abs(dy * way[0]) : Math.hypot(dx, dy);
      if (way && ahead < 1e-3) return;
      const cost = ahead + 2.5 * aside;
      if (cost < least - 1e-6) [best, least] = [k, cost];
    });
    return best;
  }
  function key(event) {
    if (!focused) return;
    const [kind, k] = focused, { at, nodes } = groups[kind];
    let [next, to] = [kind, -1];
    if (WAYS[event.key]) to = nearest(kind, at(k), WAYS[event.key], k);
    else if (event.key === "Home") to = 0;
    else if (event.key === "End") to = nodes.length - 1;
    else if (event.key === "d" || event.key === "c") {
      next = event.key === "d" ? "disc" : "contact";
      to = kind === "bar" && next === "disc" ? base[k][0] : nearest(next, kind === "bar" ? groups.disc.at(base[k][0]) : at(k), null, -1);
    } else return;
    event.preventDefault();
    if (to >= 0) go(next, to);
  }
  for (const [kind, { nodes }] of Object.entries(groups)) {
    (kind === "bar" ? placeNodes : nodes).forEach((n, k) => {
      n.addEventListener("pointerenter", () => show([kind, k]));
      n.addEventListener("pointerleave", () => show(focused));
      n.addEventListener("click", () => go(kind, k));
    });
    nodes.forEach((n, k) => {
      n.addEventListener("focus", () => { focused = [kind, k]; show(focused); });
      n.addEventListener("blur", () => { focused = null; });
      n.addEventListener("keydown", key);
    });
    if (nodes.length) nodes[0].setAttribute("tabindex", 0);
  }

  // ---- the slider ----------------------------------------------------------------------------
  const slider = $("push");
  let timer = 0, dragged = false;
  const named = (list) => list.map((k) => contacts[k][0]).join(", ");
  function tell() {
    const [piece, j] = place(), corner = j === STEPS ? piece + 1 : piece, here = j === 0 || j === STEPS;
    const [opens, closes] = here ? path.changes[corner] : [[], []];
    let text = `between ${corner ? `breakpoint ${corner}` : "the start"} and ${corner + 1 === pieces ? "the end" : `breakpoint ${corner + 1}`}`;
    if (here) {
      const what = [closes.length ? `closes ${named(closes)}` : "", opens.length ? `opens ${named(opens)}` : ""].filter(Boolean).join("; ");
      const name = corner === 0 ? "the start" : corner === pieces ? `the end: ${path.end}` : `breakpoint ${corner} of ${pieces - 1}`;
      text = name + (what ? `: ${what}` : "");
    }
    $("where").textContent = `${text}; push ${shortly(exact("push", 0), pushNow(), "")}`;
    slider.setAttribute("aria-valuetext", `${text}; push about ${near(pushNow())}`);
    hitNodes.forEach((n, k) => n.classList.toggle("changed", opens.includes(k) || closes.includes(k)));
  }
  function move(to) {
    position = Math.max(0, Math.min(to, STEPS * pieces));
    slider.value = position;
    draw();
    show(shown);
  }
  function stop() { clearInterval(timer); timer = 0; $("play").textContent = "Play"; $("where").removeAttribute("aria-live"); }
  if (path) {
    $("travel").hidden = false;
    slider.max = STEPS * pieces;
    slider.addEventListener("pointerdown", () => { dragged = true; });
    window.addEventListener("pointerup", () => { dragged = false; });
    slider.addEventListener("input", () => {
      stop();
      let to = Number(slider.value);
      const corner = STEPS * Math.round(to / STEPS), catches = Math.max(1, 5 * STEPS * pieces / slider.clientWidth);
      if (dragged && Math.abs(to - corner) <= catches) to = corner;
      move(to);
    });
    const jump = (way) => { stop(); move(STEPS * (way > 0 ? Math.floor(position / STEPS) + 1 : Math.ceil(position / STEPS) - 1)); };
    $("back").addEventListener("click", () => jump(-1));
    $("on").addEventListener("click", () => jump(1));
    slider.addEventListener("keydown", (event) => {
      const way = { PageUp: 1, PageDown: -1 }[event.key];
      if (way) { event.preventDefault(); jump(way); }
    });
    $("play").addEventListener("click", () => {
      if (timer) return stop();
      if (position === STEPS * pieces) move(0);
      $("play").textContent = "Pause";
      $("where").setAttribute("aria-live", "off"); // nobody can listen to that many places
      timer = setInterval(() => { move(position + 1); if (position === STEPS * pieces) stop(); }, 70);
    });
    $("travel").addEventListener("submit", (event) => event.preventDefault());
  }
  ["width", "absent", "axes"].forEach((id) => $(id).addEventListener("change", draw));
  const count = (state) => contacts.filter((_, k) => stateOf(k) === state).length;
  $("facts").textContent = [`${discs.length} discs, ${contacts.length} contacts`, ...["closed", "open", "osculatory"].map((s) => `${count(s)} ${s}${path && s === "osculatory" ? " at the start" : ""}`), data.verdict, data.exact ? "exact numbers" : "floating point", bounds ? `bounds with friction ${bounds.mu}` : ""].filter(Boolean).join("; ");
  draw();
})();
