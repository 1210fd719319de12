/* Two laws from one start, alive: every change runs both episodes again (live-episode.js) and draws them. What is chosen
   stands in the address. No library; follows light and dark; at most BUDGET_MS of a frame goes into episodes. The ball of
   starts (live-map.js) is computed again where the law or a setting changes. */
(function () {
  "use strict";
  const { product, conjugate, normalized, about, rotationVector, scaled, dot } = window.liveSpace;
  const SIDES = ["a", "b"], DASHES = { a: [], b: [7, 4] }, DEG = 180 / Math.PI;
  const BUDGET_MS = 8, BLOCK = 250, HORIZON_S = 6, SHORTEST_S = 1, SLOWDOWN = 2, PAUSE_MS = 250, SMALLEST_TURN = 0.01,
        AT_THE_END_MS = 1200;
  const byId = id => document.getElementById(`live-${id}`);
  const both = f => SIDES.map(f);

  const { SLIDERS } = window.liveSliders, { SETTINGS, ITS_OWN } = window.liveAddress;

  let data, address, episodes, plots, ball, starts, gripper, faced, writing, saying, frame = null, clockStarted = null;
  let isToPlay = false, isToRest = false, isResting = false;
  const view = { time: 0, axis: [0, 0, 1] };

  // ---- the start

  function startAt(id) {
    Object.assign(view, address.startOf(id));
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
  function playFrom(q) { // a dot of the ball
    Object.assign(view, { q, omega: [0, 0, 0], start: ITS_OWN });
    noteAxis();
    rerun();
    isToPlay = true;
  }

  // ---- the episodes

  const settings = () => ({
    kp: view.kp, kv: view.kv, period_s: 1 / view.rate, delay_s: view.delay / 1000, attitude_noise: view.noise, rate_noise: 0,
    worst_attitude_error: view.off, bound: view.bound, inertia: [view.inertia, 1, 1 / view.inertia], horizon_s: HORIZON_S,
  });
  function begun(side) {
    const [R, R_d] = [view.q, view.goal].map(window.live.plant.from_quaternion), { rules } = data;
    const band = window.liveEpisode.bandOf(window.live.plant.angle_between(R, R_d), rules);
    return window.liveEpisode.begin(window.live.laws[view[side]], { R, omega: view.omega, R_d, band }, settings(), rules);
  }
  function rerun() {
    pause();
    episodes = Object.fromEntries(SIDES.map(side => [side, begun(side)]));
    view.time = 0;
    isToPlay = isToRest = isResting = false;
    writeAddress();
    starts.update(view, settings());
    clearTimeout(saying);
    window.liveFacts.wait(view, data);
    if (frame === null) frame = requestAnimationFrame(goOn);
  }
  function goOn() { // as far as a frame's budget lets both
    const end = performance.now() + BUDGET_MS;
    const open = () => Object.values(episodes).filter(one => !one.isDone);
    while (open().length && performance.now() < end) open().forEach(one => one.advance(BLOCK));
    frame = open().length ? requestAnimationFrame(goOn) : null;
    showAll();
    if (frame !== null) return;
    saying = setTimeout(() => window.liveFacts.say(view, episodes, data), PAUSE_MS);
    if (isToPlay) play();
    else if (isToRest) rest();
  }
  const lastTime = side => (episodes[side].samples.length - 1) * episodes[side].sample_s;
  const endTime = () => Math.max(SHORTEST_S, ...both(lastTime));
  function sampleAt(side, time) {
    const { samples, sample_s } = episodes[side];
    return samples[Math.min(Math.round(time / sample_s), samples.length - 1)];
  }

  function timeOfContrast() { // the slower body is half way; if it never is, the other one has settled
    const halves = both(side => {
      const { samples, sample_s } = episodes[side], tick = samples.findIndex(one => one.angle < samples[0].angle / 2);
      return tick < 0 ? Infinity : tick * sample_s;
    });
    if (halves.every(Number.isFinite)) return Math.max(...halves);
    const settled = both(side => episodes[side].settling_s).filter(Number.isFinite);
    return settled.length ? Math.min(...settled) : endTime();
  }

  // ---- the address

  function showView(text) { // and play it, unless the reader wants no motion
    Object.assign(view, address.parse(text));
    byId("log").checked = view.log;
    byId("colouring").value = view.ball;
    noteAxis();
    rerun();
    isToPlay = !window.matchMedia("(prefers-reduced-motion: reduce)").matches;
    isToRest = !isToPlay;
  }
  const hash = () => address.nameOf(view) || address.format(view);
  function writeAddress() { // once the reader pauses: browsers stop pages that do so at every key
    const name = address.nameOf(view);
    byId("watch").textContent = name ? data.presets[name].watch : "";
    for (const button of document.querySelectorAll("[data-preset]")) {
      button.setAttribute("aria-pressed", button.dataset.preset === name);
      if (button.dataset.preset === name) bringIntoStrip(button);
    }
    clearTimeout(writing);
    writing = setTimeout(() => history.replaceState(null, "", `#${hash()}`), PAUSE_MS);
  }
  function bringIntoStrip(button) { // on a phone the presets are one line that scrolls; the page itself stays where it is
    const strip = button.closest(".live-presets"), [outer, inner] = [strip, button].map(one => one.getBoundingClientRect());
    strip.scrollLeft += inner.left + inner.width / 2 - (outer.left + outer.width / 2);
  }
  function copyLink() {
    window.liveFacts.copyText(`${location.href.split("#")[0]}#${hash()}`, byId("link"));
    setTimeout(() => { byId("link").textContent = "Copy link"; }, 2000);
  }

  // ---- pictures

  function colourIn() { // a law's own; of two laws that are both grey, B takes another neutral, and its line is dashed
    const [a, own] = both(side => data.laws[view[side]].colour), { style } = byId("page");
    const b = own[0] === a[0] ? data.neutrals.find(one => one[0] !== a[0]) : own;
    const onEither = ([light, dark]) => `light-dark(${light}, ${dark})`;
    style.setProperty("--a", onEither(a));
    style.setProperty("--b", onEither(b));
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
    const left = ({ R }) => {
      const [w, v] = turn_quaternion(R_d, R);
      return scaled(1 / Math.PI, rotationVector([w, ...v]));
    };
    const hands = both((side, i) => {
      const sample = sampleAt(side, view.time), vector = left(sample), length = Math.hypot(...vector);
      const axis = length > SMALLEST_TURN ? scaled(1 / length, vector) : null;
      return { R: sample.R, colour: [a, b][i], axis, name: `${side.toUpperCase()}  ${(sample.angle * DEG).toFixed(1)}°` };
    });
    gripper.draw(R_d, hands);
    const ways = both((side, i) => ({
      points: episodes[side].samples.map(left), now: left(sampleAt(side, view.time)), colour: [a, b][i], dashes: DASHES[side],
    }));
    if (faced !== view.start && view.start !== ITS_OWN) ball.face(ways[0].points[0]);
    faced = view.start;
    ball.draw({ ways });
  }
  function showControls() {
    for (const side of SIDES) byId(side).value = view[side];
    byId("start").value = view.start;
    window.liveSliders.show({ ...view, angle: Math.hypot(...toGo()) * DEG, spin: dot(view.omega, view.axis) });
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
    if (isResting || view.time >= endTime() - 0.005) view.time = 0;
    isResting = false;
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
    if (view.time < endTime()) { requestAnimationFrame(tick); return; }
    pause();
    setTimeout(() => { if (view.time >= endTime() && clockStarted === null) rest(); }, AT_THE_END_MS);
  }
  function rest() { // at the end both bodies may be at the goal, and nothing would tell the laws apart
    view.time = timeOfContrast();
    isResting = true;
    showTime();
  }

  // ---- all together

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
      isResting = false;
      view.time = Number(byId("time").value);
      showTime();
    });
    for (const button of document.querySelectorAll("[data-preset]"))
      button.addEventListener("click", () => showView(button.dataset.preset));
    byId("link").addEventListener("click", copyLink);
    byId("colouring").addEventListener("change", () => {
      view.ball = byId("colouring").value;
      writeAddress();
      starts.update(view, settings());
    });
    window.addEventListener("hashchange", () => {
      const text = location.hash.slice(1);
      if (text.includes("a=") || text in data.presets) showView(text); // else a heading of the page
    });
    new MutationObserver(() => { showAll(); starts.redraw(); }).observe(document.documentElement, { attributeFilter: ["data-theme"] });
    new ResizeObserver(showAll).observe(byId("page"));
  }
  function start() {
    data = JSON.parse(byId("data").textContent);
    byId("page").hidden = false;
    window.liveSliders.add(moved);
    address = window.liveAddress.make(data);
    ball = window.ball.make(byId("ball"), { onPick: i => playFrom(starts.pick(i)), onMark: i => starts.describe(i) });
    starts = window.liveStarts.make(ball, data.rules);
    gripper = window.liveGripper.make(byId("gripper"), { turn: turnStart });
    plots = [window.livePlot.make(byId("angle-plot"), 0.01), window.livePlot.make(byId("command-plot"), 0.1)];
    showView(location.hash.slice(1));
    listen();
    document.fonts.ready.then(showAll);
  }
  if (byId("page")) start(); // the script is deferred: the page is there
})();
