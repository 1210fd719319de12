/* Two laws from one start, alive: every change runs both episodes again (live-episode.js) and draws them. What is chosen
   stands in the address. No library; follows light and dark; at most BUDGET_MS of a frame goes into episodes. */
(function () {
  "use strict";
  const { product, conjugate, normalized, about, rotationVector, scaled, dot } = window.liveSpace;
  const SIDES = ["a", "b"], DASHES = { a: [], b: [7, 4] }, DEG = 180 / Math.PI;
  const BUDGET_MS = 8, BLOCK = 250, HORIZON_S = 6, SHORTEST_S = 1, SLOWDOWN = 2, PAUSE_MS = 250, ITS_OWN = "own";
  const { ending, turned, peak } = window.liveWords;
  const byId = id => document.getElementById(`live-${id}`);
  const both = f => SIDES.map(f);
  const make = (tag, properties) => Object.assign(document.createElement(tag), properties);

  const { SLIDERS } = window.liveSliders;
  const SETTINGS = Object.keys(SLIDERS).filter(name => "usual" in SLIDERS[name]);

  let data, episodes, plots, ball, gripper, faced, writing, saying, frame = null, clockStarted = null;
  const view = { a: "", b: "", start: "", log: false, time: 0, axis: [0, 0, 1] };

  // ---- the start

  function startAt(id) {
    const { q, omega, goal } = data.starts.find(one => one.id === id);
    Object.assign(view, { start: id, q, omega, goal });
    noteAxis();
  }
  function toGo() { return rotationVector(product(view.q, conjugate(view.goal))); }
  function noteAxis() { // the last one stays where there is none
    const vector = toGo(), angle = Math.hypot(...vector);
    if (angle > 1e-9) view.axis = scaled(1 / angle, vector);
  }
  function turnStart(turns) {
    view.q = normalized(turns.reduce((q, turn) => product(turn, q), view.q));
    view.start = ITS_OWN;
    noteAxis();
    rerun();
  }
  function moved(name, value) {
    if (name === "angle") view.q = normalized(product(about(view.axis, value / DEG), view.goal));
    if (name === "spin") view.omega = scaled(value, view.axis);
    if (name === "angle" || name === "spin") view.start = ITS_OWN;
    else view[name] = value;
    rerun();
  }

  // ---- the episodes

  function normals(seed) { // Box and Muller's, of a small generator that restarts with every episode
    let state = seed;
    const uniform = () => {
      state = (state + 0x6d2b79f5) | 0;
      let t = Math.imul(state ^ (state >>> 15), 1 | state);
      t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
      return (((t ^ (t >>> 14)) >>> 0) + 0.5) / 4294967296;
    };
    return () => Array.from({ length: 6 }, () => Math.sqrt(-2 * Math.log(uniform())) * Math.cos(2 * Math.PI * uniform()));
  }
  function begun(side) {
    const [R, R_d] = [view.q, view.goal].map(window.live.plant.from_quaternion), { rules } = data;
    const band = window.liveEpisode.bandOf(window.live.plant.angle_between(R, R_d), rules);
    const settings = {
      kp: view.kp, kv: view.kv, period_s: 1 / view.rate, delay_s: view.delay / 1000, attitude_noise: view.noise,
      rate_noise: 0, draw: normals(1), bound: view.bound, inertia: [view.inertia, 1, 1 / view.inertia], horizon_s: HORIZON_S,
    };
    return window.liveEpisode.begin(window.live.laws[view[side]], { R, omega: view.omega, R_d, band }, settings, rules);
  }
  function rerun() {
    pause();
    episodes = Object.fromEntries(SIDES.map(side => [side, begun(side)]));
    view.time = 0;
    writeAddress();
    clearTimeout(saying);
    if (frame === null) frame = requestAnimationFrame(goOn);
  }
  function goOn() { // as far as a frame's budget lets both
    const end = performance.now() + BUDGET_MS;
    const open = () => Object.values(episodes).filter(one => !one.isDone);
    while (open().length && performance.now() < end) open().forEach(one => one.advance(BLOCK));
    frame = open().length ? requestAnimationFrame(goOn) : null;
    showAll();
    if (frame === null) saying = setTimeout(say, PAUSE_MS);
  }
  const lastTime = side => (episodes[side].samples.length - 1) * episodes[side].sample_s;
  const endTime = () => Math.max(SHORTEST_S, ...both(lastTime));
  function sampleAt(side, time) {
    const { samples, sample_s } = episodes[side];
    return samples[Math.min(Math.round(time / sample_s), samples.length - 1)];
  }

  // ---- the address

  function readAddress() {
    const given = new URLSearchParams(location.hash.slice(1));
    for (const side of SIDES) view[side] = given.get(side) in window.live.laws ? given.get(side) : data.opening[side];
    const number = text => (text === "none" ? Infinity : Number(text));
    const numbers = name => (given.get(name) || "").split(",").map(Number);
    startAt(data.starts.some(one => one.id === given.get("start")) ? given.get("start") : data.opening.start);
    for (const [name, key, size] of [["q", "q", 4], ["w", "omega", 3], ["goal", "goal", 4]]) {
      const found = numbers(name);
      if (found.length !== size || !found.every(Number.isFinite) || (size === 4 && !found.some(Boolean))) continue;
      Object.assign(view, { [key]: size === 4 ? normalized(found) : found, start: ITS_OWN });
    }
    noteAxis();
    for (const name of SETTINGS) {
      const { from, to, value, place, usual } = SLIDERS[name], wanted = given.has(name) ? number(given.get(name)) : usual;
      view[name] = wanted >= value(from) && wanted <= value(to) && !Number.isNaN(place(wanted)) ? wanted : usual;
    }
    byId("log").checked = view.log = given.get("log") === "1";
  }
  function writeAddress() { // once the reader pauses: browsers stop pages that do so at every key
    clearTimeout(writing);
    writing = setTimeout(() => {
      const { a, b, start, q, omega, goal, log } = view, words = new URLSearchParams({ a, b });
      if (start !== ITS_OWN) words.set("start", start);
      else Object.entries({ q, w: omega, goal }).forEach(([name, value]) => words.set(name, value.join(",")));
      const changed = SETTINGS.filter(name => view[name] !== SLIDERS[name].usual);
      for (const name of changed) words.set(name, view[name] === Infinity ? "none" : view[name]);
      if (log) words.set("log", "1");
      history.replaceState(null, "", `#${words.toString().replace(/%2C/g, ",").replace(/%2F/g, "/")}`);
    }, PAUSE_MS);
  }

  // ---- words

  const ended = side => ending(episodes[side], data.rules);
  function code(side) {
    const button = make("button", { type: "button", textContent: "Copy" });
    button.setAttribute("aria-label", `Copy law ${side.toUpperCase()} as JavaScript`);
    button.addEventListener("click", () => copy(side, button));
    const more = make("a", { href: data.laws[view[side]].card, textContent: "C, C++, Python" });
    const cell = make("span", { className: "live-code" });
    cell.append(button, " ", more);
    return cell;
  }
  function copy(side, button) { // the very functions that run here
    const { needs, memory } = window.live.laws[view[side]], law = needs[needs.length - 1];
    const usage = memory ? `[u, memory] = ${law}(R, omega, goal, [kp, kv], memory); memory = ${JSON.stringify(memory)} at first`
      : `u = ${law}(R, omega, goal, [kp, kv])`;
    const lines = [`// ${data.laws[view[side]].name}: ${usage}`, "// R: its three columns; goal = [R_d, [0, 0, 0], [0, 0, 0]]; base frame"];
    const text = [...lines, ...needs.map(name => window.live.functions[name].toString())].join("\n\n") + "\n";
    const area = make("textarea", { value: text, className: "live-copied" });
    button.after(area);
    area.select();
    const isCopied = document.execCommand("copy"); // works from a file too, where the clipboard of pages does not
    area.remove();
    button.dataset.copied = isCopied ? text : "";
    button.textContent = isCopied ? "Copied" : "Not copied";
    button.focus();
  }
  const FACTS = [
    ["What it is", side => make("a", { href: data.laws[view[side]].card, textContent: data.laws[view[side]].title })],
    ["From here it", side => ended(side)],
    ["Turns through", side => turned(episodes[side])],
    ["Greatest command", side => peak(episodes[side], data.rules)],
    ["A tick costs", side => data.laws[view[side]].cost],
    ["Its code", code],
  ];
  function fillFacts() {
    const table = document.querySelector(".live-facts");
    for (const side of SIDES) table.querySelector(`th.${side}`).textContent = data.laws[view[side]].name;
    table.tBodies[0].replaceChildren(...FACTS.map(([label, value]) => {
      const row = make("tr");
      row.append(make("th", { scope: "row", textContent: label }), make("td"), make("td"));
      SIDES.forEach((side, i) => row.cells[i + 1].append(value(side)));
      return row;
    }));
  }
  function say() { // to be seen, and to be read out when it changes
    const lines = both(side => `${side.toUpperCase()}: ${data.laws[view[side]].name} ${ended(side)}.`);
    if (byId("said").textContent.trim() === lines.join(" ")) return;
    const spans = lines.map((line, i) => make("span", { className: SIDES[i], textContent: line }));
    byId("said").replaceChildren(...spans.flatMap(span => [span, " "]));
    fillFacts();
  }

  // ---- pictures

  function colourIn() { // a law's own; if both have one colour, B takes that of the text
    const [a, b] = both(side => data.laws[view[side]].colour), { style } = byId("page");
    const onEither = ([light, dark]) => `light-dark(${light}, ${dark})`;
    style.setProperty("--a", onEither(a));
    style.setProperty("--b", a[0] === b[0] ? "var(--pst-color-text-base)" : onEither(b));
  }
  const colours = () => both(side => getComputedStyle(document.querySelector(`.live-key.${side}`)).color);
  function plotted(quantity, scale, band) {
    const curves = both(side => {
      const { samples, sample_s, settling_s, isDone } = episodes[side];
      const hasFailed = isDone && ["diverged", "singular", "saturated"].includes(episodes[side].outcome);
      const values = samples.map(one => one[quantity] * scale);
      return { side, values, step_s: sample_s, settling_s, hasFailed, dashes: DASHES[side] };
    });
    return { curves, end: endTime(), isLog: view.log, time: view.time, ...(band && { band }) };
  }
  function drawBodies() {
    const [a, b] = colours(), { from_quaternion, turn_quaternion } = window.live.plant, R_d = from_quaternion(view.goal);
    const hands = both((side, i) => ({ R: sampleAt(side, view.time).R, colour: [a, b][i], alpha: i ? 0.55 : 1 }));
    gripper.draw(R_d, hands);
    const pointOf = ({ R }) => {
      const [w, v] = turn_quaternion(R_d, R);
      return scaled(1 / Math.PI, rotationVector([w, ...v]));
    };
    const ways = both((side, i) => ({
      points: episodes[side].samples.map(pointOf), now: pointOf(sampleAt(side, view.time)), colour: [a, b][i], dashes: DASHES[side],
    }));
    if (faced !== view.start && view.start !== ITS_OWN) ball.face(ways[0].points[0]);
    faced = view.start;
    ball.draw(ways);
  }
  function showControls() {
    for (const side of SIDES) byId(side).value = view[side];
    byId("start").value = view.start;
    const current = { ...view, angle: Math.hypot(...toGo()) * DEG, spin: dot(view.omega, view.axis) };
    for (const [name, { place, text, usual }] of Object.entries(SLIDERS)) {
      const input = byId(name), said = text(current[name]);
      if (document.activeElement !== input) input.value = place(current[name]);
      input.setAttribute("aria-valuetext", said);
      byId(`${name}-now`).textContent = said;
      input.parentElement.classList.toggle("changed", usual !== undefined && usual !== current[name]);
    }
  }
  function showAll() {
    if (!both(side => episodes[side].samples.length).every(Boolean)) return;
    colourIn();
    showControls();
    const band = DEG * 2 * Math.asin(Math.sqrt(window.liveEpisode.bandOf(Math.hypot(...toGo()), data.rules)));
    plots[0].draw(plotted("angle", DEG, band));
    plots[1].draw(plotted("command", 1));
    byId("time").max = endTime().toFixed(2);
    showTime();
  }
  function showTime() {
    const angles = both(side => `${side.toUpperCase()} ${(sampleAt(side, view.time).angle * DEG).toFixed(1)}°`);
    byId("time").value = view.time;
    byId("time").setAttribute("aria-valuetext", `${view.time.toFixed(2)} s: ${angles.join(", ")}`);
    byId("now").textContent = `${view.time.toFixed(2)} s`;
    plots.forEach(one => one.mark(view.time));
    drawBodies();
  }

  // ---- the clock

  function play() {
    if (view.time >= endTime() - 0.005) view.time = 0;
    clockStarted = performance.now() - SLOWDOWN * 1000 * view.time;
    byId("play").textContent = "Pause";
    requestAnimationFrame(tick);
  }
  function pause() {
    clockStarted = null;
    byId("play").textContent = "Play";
  }
  function tick(now) {
    if (clockStarted === null) return;
    view.time = Math.min(Math.max(0, (now - clockStarted) / 1000 / SLOWDOWN), endTime());
    showTime();
    if (view.time < endTime()) requestAnimationFrame(tick);
    else pause();
  }

  // ---- all together

  function addSliders() {
    for (const [name, { label, from, to, step, value }] of Object.entries(SLIDERS)) {
      const input = make("input", { type: "range", id: `live-${name}`, min: from, max: to, step });
      const output = make("output", { id: `live-${name}-now` }), row = make("p");
      output.setAttribute("for", input.id);
      row.append(make("label", { htmlFor: input.id, textContent: label }), output, input);
      byId(["angle", "spin"].includes(name) ? "start-sliders" : "sliders").append(row);
      input.addEventListener("input", () => moved(name, value(Number(input.value))));
    }
  }
  function walk(by) {
    const { options, selectedIndex } = byId("start"), count = options.length - 1; // the last one is the reader's own
    startAt(options[(selectedIndex + by + (selectedIndex === count ? by < 0 : count)) % count].value);
    rerun();
  }
  function listen() {
    for (const side of SIDES) byId(side).addEventListener("change", () => { view[side] = byId(side).value; rerun(); });
    byId("start").addEventListener("change", () => {
      if (byId("start").value !== ITS_OWN) startAt(byId("start").value);
      rerun();
    });
    byId("log").addEventListener("change", () => { view.log = byId("log").checked; writeAddress(); showAll(); });
    byId("previous").addEventListener("click", () => walk(-1));
    byId("next").addEventListener("click", () => walk(1));
    byId("reset").addEventListener("click", () => {
      for (const name of SETTINGS) view[name] = SLIDERS[name].usual;
      rerun();
    });
    byId("play").addEventListener("click", () => (clockStarted === null ? play() : pause()));
    byId("time").addEventListener("input", () => {
      pause();
      view.time = Number(byId("time").value);
      showTime();
    });
    for (const button of document.querySelectorAll("[data-view]"))
      button.addEventListener("click", () => { location.hash = button.dataset.view; });
    window.addEventListener("hashchange", () => {
      if (!location.hash.includes("a=")) return; // a heading of the page
      readAddress();
      rerun();
    });
    new MutationObserver(showAll).observe(document.documentElement, { attributeFilter: ["data-theme"] });
    new ResizeObserver(showAll).observe(byId("page"));
  }
  function start() {
    data = JSON.parse(byId("data").textContent);
    byId("page").hidden = false;
    addSliders();
    ball = window.liveBall.make(byId("ball"));
    gripper = window.liveGripper.make(byId("gripper"), { turn: turnStart });
    plots = [window.livePlot.make(byId("angle-plot"), 0.01), window.livePlot.make(byId("command-plot"), 0.1)];
    readAddress();
    rerun();
    listen();
    document.fonts.ready.then(showAll);
  }
  if (byId("page")) start(); // the script is deferred: the page is there
})();
