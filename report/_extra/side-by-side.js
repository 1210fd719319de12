/* Two laws from one start: angle and command over time, the ways through the ball of rotations, one clock for all.
   Reads the JSON of #side-data; what is chosen stands in the address. No library, follows light and dark. */
(function () {
  "use strict";
  const SIDES = ["a", "b"], DASHES = { a: [], b: [7, 4] }, DEG = 180 / Math.PI;
  const SLOWDOWN = 2, SHORTEST_S = 1, PAUSE_MS = 200, SVG = "http://www.w3.org/2000/svg";
  const byId = id => document.getElementById(`side-${id}`);

  let data, writing, clockStarted = null;
  const view = { a: "", b: "", start: "", log: false, time: 0 };

  // ---- the data: whole numbers in units, a sample every step

  const curveOf = side => data.curves[view[side]][view.start];
  const both = f => SIDES.map(f);

  function samples(side, quantity) {
    const scale = quantity === "angle" ? data.units.angle * DEG : data.units.command;
    return curveOf(side)[quantity].map(whole => (whole === null ? null : whole * scale));
  }
  function turns(side) { // rotation vectors over pi
    const { turn } = curveOf(side), scale = data.units.turn / Math.PI, points = [];
    for (let i = 0; i < turn.length; i += 3) points.push(turn.slice(i, i + 3).map(whole => whole * scale));
    return points;
  }
  function lastTime(side) { return (curveOf(side).angle.length - 1) * data.step_s; }
  function endTime() { return Math.max(SHORTEST_S, ...both(lastTime)); }

  function at(values, time) { // between samples in proportion; the last one stays
    const place = Math.min(time / data.step_s, values.length - 1), i = Math.floor(place);
    const before = values[i], after = values[Math.min(i + 1, values.length - 1)];
    return before === null || after === null ? before : before + (place - i) * (after - before);
  }
  function pointAt(points, time) {
    const i = Math.min(Math.floor(time / data.step_s + 1e-9), points.length - 1);
    const next = points[Math.min(i + 1, points.length - 1)];
    if (isJump(points[i], next)) return points[i];
    return points[i].map((_, axis) => at(points.map(point => point[axis]), time));
  }
  function isJump(p, q) { return Math.hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]) > 1; } // to the far side of the ball

  // ---- what is chosen, and the address

  function readAddress() {
    const given = new URLSearchParams(location.hash.slice(1));
    for (const name of [...SIDES, "start"]) {
      const isThere = [...byId(name).options].some(option => option.value === given.get(name));
      if (isThere) byId(name).value = given.get(name);
      view[name] = byId(name).value;
    }
    byId("log").checked = view.log = given.get("log") === "1";
    view.time = Math.min(Math.max(0, Number(given.get("t")) || 0), endTime());
  }
  function writeAddress() { // once the reader pauses: browsers stop pages that do so at every key
    clearTimeout(writing);
    writing = setTimeout(() => {
      const { a, b, start, log, time } = view;
      const words = new URLSearchParams({ a, b, start, ...(log && { log: 1 }), ...(time && { t: time.toFixed(2) }) });
      history.replaceState(null, "", `#${words}`);
    }, PAUSE_MS);
  }
  function choose() {
    for (const name of [...SIDES, "start"]) view[name] = byId(name).value;
    view.log = byId("log").checked;
    view.time = Math.min(view.time, endTime());
    writeAddress();
    showAll();
  }
  function step(by) {
    const { options, selectedIndex } = byId("start");
    byId("start").selectedIndex = (selectedIndex + by + options.length) % options.length;
    choose();
  }

  // ---- colours: a law's own; if both have one colour, B takes that of the text

  function colourIn() {
    const [a, b] = both(side => data.laws[view[side]].colour);
    const { style } = byId("by-side"), onEither = ([light, dark]) => `light-dark(${light}, ${dark})`;
    style.setProperty("--a", onEither(a));
    style.setProperty("--b", a[0] === b[0] ? "var(--pst-color-text-base)" : onEither(b));
  }

  // ---- words

  const FACTS = [
    ["What it is", side => linkTo(data.laws[view[side]])],
    ["From here it", side => curveOf(side).ending],
    ["Turns through", side => curveOf(side).turned],
    ["Greatest command", side => curveOf(side).peak],
    ["A tick costs", side => data.laws[view[side]].cost],
  ];
  function make(tag, properties) { return Object.assign(document.createElement(tag), properties); }
  function linkTo(law) { return make("a", { href: law.card, textContent: law.title }); }

  function fillFacts() {
    const table = document.querySelector(".side-facts");
    for (const side of SIDES) table.querySelector(`th.${side}`).textContent = data.laws[view[side]].name;
    table.tBodies[0].replaceChildren(...FACTS.map(([label, value]) => {
      const row = make("tr");
      row.append(make("th", { scope: "row", textContent: label }), make("td"), make("td"));
      SIDES.forEach((side, i) => row.cells[i + 1].append(value(side)));
      return row;
    }));
  }
  function say() { // to be seen, and to be read out when it changes
    const ends = both(side => `${side.toUpperCase()}: ${data.laws[view[side]].name} ${curveOf(side).ending}.`);
    const lines = [`${data.starts[view.start]}.`, ...ends], classes = ["", ...SIDES];
    if (byId("said").textContent.trim() === lines.join(" ")) return;
    const spans = lines.map((line, i) => make("span", { className: classes[i], textContent: line }));
    byId("said").replaceChildren(...spans.flatMap(span => [span, " "]));
  }

  // ---- a plot over time

  function add(parent, name, attributes, text) {
    const element = document.createElementNS(SVG, name);
    for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
    if (text !== undefined) element.textContent = text;
    parent.append(element);
    return element;
  }
  function niceStep(span, most) { // 1, 2 or 5 times a power of ten
    const power = 10 ** Math.floor(Math.log10(span / most));
    return [1, 2, 5, 10].map(n => n * power).find(size => span / size <= most);
  }
  function ticks(from, to, most) {
    const size = niceStep(to - from, most), count = Math.floor((to - from) / size + 1e-9);
    return Array.from({ length: count + 1 }, (_, i) => Number((from + i * size).toPrecision(12)));
  }
  function decades(from, to) {
    const first = Math.ceil(Math.log10(from) - 1e-9), last = Math.floor(Math.log10(to) + 1e-9);
    const every = Math.ceil((last - first + 1) / 5);
    return Array.from({ length: Math.floor((last - first) / every) + 1 }, (_, i) => 10 ** (first + i * every));
  }
  function numberText(value) { // 0.01, 150, 20 000, 2·10⁵
    if (value < 1e5 && (value === 0 || value >= 0.01))
      return value.toLocaleString("en", { maximumFractionDigits: 4 }).replace(/,/g, "\u202f");
    const power = Math.floor(Math.log10(value) + 1e-9), mantissa = Number((value / 10 ** power).toPrecision(3));
    return `${mantissa === 1 ? "" : `${mantissa}·`}10${raised(power)}`;
  }
  const raised = power => String(power).replace(/./g, sign => "⁰¹²³⁴⁵⁶⁷⁸⁹"[sign] || "⁻");

  function makePlot(svg, quantity, floor) {
    const box = { left: 44, right: 8, top: 8, bottom: 24, height: 190 };
    let place, marks;

    function scales() {
      const width = svg.clientWidth, end = endTime(), values = both(side => samples(side, quantity)).flat();
      const top = Math.max(...values, 10 * floor), inner = box.height - box.top - box.bottom;
      const part = view.log ? v => Math.log(Math.max(v, floor) / floor) / Math.log(top / floor) : v => v / (1.04 * top);
      return {
        width, end, top,
        x: time => box.left + (time / end) * (width - box.left - box.right),
        y: value => box.height - box.bottom - inner * Math.min(1, part(value)),
      };
    }
    function drawAxes() {
      const { width, end, top, x, y } = place, floorY = box.height - box.bottom;
      for (const value of view.log ? decades(floor, top) : ticks(0, top, 4)) {
        add(svg, "line", { class: "grid", x1: box.left, x2: width - box.right, y1: y(value), y2: y(value) });
        add(svg, "text", { x: box.left - 6, y: y(value) + 4, "text-anchor": "end" }, numberText(value));
      }
      for (const time of ticks(0, end, width < 420 ? 4 : 7)) {
        add(svg, "line", { class: "grid", x1: x(time), x2: x(time), y1: box.top, y2: floorY });
        add(svg, "text", { x: x(time), y: box.height - 7, "text-anchor": "middle" }, `${numberText(time)} s`);
      }
      add(svg, "line", { class: "axis", x1: box.left, x2: width - box.right, y1: floorY, y2: floorY });
    }
    function drawBand() { // the angle below which a law has settled
      const level = place.y(data.band * samples("a", "angle")[0]);
      add(svg, "line", { class: "band", x1: box.left, x2: place.width - box.right, y1: level, y2: level });
    }
    function drawCurve(side) {
      const { x, y } = place, values = samples(side, quantity);
      let path = "", pen = "M";
      values.forEach((value, i) => {
        if (value === null) { pen = "M"; return; }
        path += `${pen}${x(i * data.step_s).toFixed(1)} ${y(value).toFixed(1)}`;
        pen = "L";
      });
      add(svg, "path", { class: `curve ${side}`, d: path, "stroke-dasharray": DASHES[side].join(" ") });
      drawEnd(side, values);
    }
    function drawEnd(side, values) { // a ring where it settles, a cross where it breaks off
      const { settling_s } = curveOf(side), last = values.length - 1, { x, y } = place;
      if (settling_s !== null) {
        const level = y(at(values, settling_s));
        if (quantity === "angle") add(svg, "circle", { class: `ring ${side}`, cx: x(settling_s), cy: level, r: 4.5 });
      } else if (lastTime(side) < endTime() - data.step_s && values[last] !== null) {
        const cx = x(last * data.step_s), cy = y(values[last]);
        add(svg, "path", { class: `cross ${side}`, d: `M${cx - 5} ${cy - 5}l10 10m0 -10l-10 10` });
      }
    }
    function draw() {
      svg.replaceChildren();
      svg.setAttribute("height", box.height);
      place = scales();
      drawAxes();
      if (quantity === "angle") drawBand();
      SIDES.forEach(drawCurve);
      marks = {
        line: add(svg, "line", { class: "now", y1: box.top, y2: box.height - box.bottom }),
        a: add(svg, "circle", { class: "mark a", r: 5 }),
        b: add(svg, "rect", { class: "mark b", width: 9, height: 9 }),
      };
      mark();
    }
    function mark() {
      const { x, y } = place, now = x(view.time);
      marks.line.setAttribute("x1", now);
      marks.line.setAttribute("x2", now);
      for (const side of SIDES) {
        const value = at(samples(side, quantity), view.time), where = x(Math.min(view.time, lastTime(side)));
        marks[side].setAttribute("visibility", value === null ? "hidden" : "visible");
        if (value === null) continue;
        const [across, up] = side === "a" ? ["cx", "cy"] : ["x", "y"], half = side === "a" ? 0 : 4.5;
        marks[side].setAttribute(across, where - half);
        marks[side].setAttribute(up, y(value) - half);
      }
    }
    return { draw, mark };
  }

  // ---- the ball: direction is the axis of rotation, distance from the centre the angle, half a turn at the surface

  function makeBall(canvas) {
    const PITCH = 0.35, ASIDE = 0.5, STEP = 0.12, CIRCLE = 96, BEHIND = 0.45;
    const ring = f => Array.from({ length: CIRCLE + 1 }, (_, i) => f((2 * Math.PI * i) / CIRCLE));
    const RINGS = [ring(t => [Math.cos(t), Math.sin(t), 0]), ring(t => [Math.cos(t), 0, Math.sin(t)]),
                   ring(t => [0, Math.cos(t), Math.sin(t)])];
    const AXES = { x: [1, 0, 0], y: [0, 1, 0], z: [0, 0, 1] };
    const pen = canvas.getContext("2d");
    let yaw = 0, pitch = PITCH, held = null, size = 0;

    function project([x, y, z]) { // x right, z up, depth towards the reader
      const right = Math.cos(yaw) * x - Math.sin(yaw) * y, away = Math.sin(yaw) * x + Math.cos(yaw) * y;
      const up = Math.cos(pitch) * z + Math.sin(pitch) * away;
      return [size * (0.5 + 0.43 * right), size * (0.5 - 0.43 * up), Math.sin(pitch) * z - Math.cos(pitch) * away];
    }
    function line(points, colour, width, dashes = []) {
      const spots = points.map(project);
      pen.strokeStyle = colour;
      pen.lineWidth = width;
      pen.setLineDash(dashes);
      for (const isNear of [false, true]) { // what lies behind first, and paler
        let isDown = false; // as long as it can be, so that dashes go on
        pen.globalAlpha = isNear ? 1 : BEHIND;
        pen.beginPath();
        for (let i = 1; i < points.length; i++) {
          const isDrawn = (spots[i][2] >= 0) === isNear && !isJump(points[i - 1], points[i]);
          if (isDrawn && !isDown) pen.moveTo(spots[i - 1][0], spots[i - 1][1]);
          if (isDrawn) pen.lineTo(spots[i][0], spots[i][1]);
          isDown = isDrawn;
        }
        pen.stroke();
      }
      pen.globalAlpha = 1;
      pen.setLineDash([]);
    }
    function drawFrame(ink, rule) {
      pen.strokeStyle = rule;
      pen.lineWidth = 1;
      pen.beginPath();
      pen.arc(size / 2, size / 2, 0.43 * size, 0, 7);
      pen.stroke();
      for (const points of RINGS) line(points, rule, 1);
      pen.fillStyle = ink;
      pen.font = "600 14px 'Orientation Sans', sans-serif";
      pen.textAlign = "center";
      for (const [name, tip] of Object.entries(AXES)) {
        const [x, y, depth] = project(tip.map(v => 1.08 * v));
        pen.globalAlpha = depth > -0.2 ? 1 : 0.45;
        pen.fillText(name, x, y + 5);
      }
      pen.globalAlpha = 1;
    }
    function spot(side, [x, y], radius, colour, paper) {
      pen.beginPath();
      if (side === "a") pen.arc(x, y, radius, 0, 7);
      else pen.rect(x - radius, y - radius, 2 * radius, 2 * radius);
      pen.fillStyle = colour;
      pen.strokeStyle = paper;
      pen.lineWidth = 1.5;
      pen.fill();
      pen.stroke();
    }
    function drawGoal(ink) {
      const [x, y] = project([0, 0, 0]);
      pen.strokeStyle = ink;
      pen.lineWidth = 1.5;
      pen.beginPath();
      pen.moveTo(x - 6, y); pen.lineTo(x + 6, y); pen.moveTo(x, y - 6); pen.lineTo(x, y + 6);
      pen.stroke();
    }
    function draw() {
      const ratio = window.devicePixelRatio || 1, style = getComputedStyle(canvas);
      const ink = style.color, paper = style.backgroundColor, rule = style.borderTopColor;
      size = canvas.clientWidth;
      canvas.width = canvas.height = Math.round(size * ratio);
      pen.setTransform(ratio, 0, 0, ratio, 0, 0);
      drawFrame(ink, rule);
      drawGoal(ink);
      for (const side of SIDES) {
        const { color: colour } = getComputedStyle(document.querySelector(`.side-key.${side}`)), points = turns(side);
        line(points, colour, 2.2, DASHES[side]);
        spot(side, project(pointAt(points, view.time)), side === "a" ? 6 : 5, colour, paper);
      }
    }
    function face() { // so that the way from the start to the goal is seen from the side
      const [x, y] = turns("a")[0];
      yaw = Math.atan2(-y, x) - ASIDE;
      pitch = PITCH;
    }
    function turn(dx, dy) {
      yaw += dx;
      pitch = Math.max(-1.5, Math.min(1.5, pitch + dy));
      draw();
    }
    canvas.addEventListener("pointerdown", e => {
      held = [e.clientX, e.clientY];
      canvas.setPointerCapture(e.pointerId);
    });
    canvas.addEventListener("pointermove", e => {
      if (!held) return;
      turn((e.clientX - held[0]) / 150, (e.clientY - held[1]) / 150);
      held = [e.clientX, e.clientY];
    });
    for (const end of ["pointerup", "pointercancel"]) canvas.addEventListener(end, () => { held = null; });
    canvas.addEventListener("dblclick", () => { face(); draw(); });
    canvas.addEventListener("keydown", e => {
      const way = { ArrowLeft: [-STEP, 0], ArrowRight: [STEP, 0], ArrowUp: [0, -STEP], ArrowDown: [0, STEP] }[e.key];
      if (!way) return;
      e.preventDefault();
      turn(...way);
    });
    return { draw, mark: draw, face };
  }

  // ---- the clock

  function showTime() {
    const angles = both(side => `${side.toUpperCase()} ${at(samples(side, "angle"), view.time).toFixed(1)}°`);
    byId("time").value = view.time;
    byId("time").setAttribute("aria-valuetext", `${view.time.toFixed(2)} s: ${angles.join(", ")}`);
    byId("now").textContent = `${view.time.toFixed(2)} s`;
    views.forEach(one => one.mark());
  }
  function play() {
    if (view.time >= endTime() - data.step_s) view.time = 0;
    clockStarted = performance.now() - SLOWDOWN * 1000 * view.time;
    byId("play").textContent = "Pause";
    requestAnimationFrame(tick);
  }
  function pause() {
    if (clockStarted === null) return;
    clockStarted = null;
    byId("play").textContent = "Play";
    writeAddress();
  }
  function tick(now) {
    if (clockStarted === null) return;
    view.time = Math.min(Math.max(0, (now - clockStarted) / 1000 / SLOWDOWN), endTime());
    showTime();
    if (view.time < endTime()) requestAnimationFrame(tick);
    else pause();
  }

  // ---- all together

  let views = [], ball, faced = "";

  function showAll() {
    colourIn();
    say();
    fillFacts();
    byId("time").max = endTime().toFixed(2);
    if (faced !== view.start) ball.face();
    faced = view.start;
    views.forEach(one => one.draw());
    showTime();
  }
  function listen() {
    for (const name of [...SIDES, "start", "log"]) byId(name).addEventListener("change", choose);
    byId("previous").addEventListener("click", () => step(-1));
    byId("next").addEventListener("click", () => step(1));
    byId("play").addEventListener("click", () => (clockStarted === null ? play() : pause()));
    byId("time").addEventListener("input", () => {
      pause();
      view.time = Number(byId("time").value);
      showTime();
    });
    byId("time").addEventListener("change", writeAddress);
    for (const button of document.querySelectorAll("[data-view]"))
      button.addEventListener("click", () => { location.hash = button.dataset.view; });
    window.addEventListener("hashchange", () => {
      if (!location.hash.includes("start=")) return; // a heading of the page
      pause();
      readAddress();
      showAll();
    });
    new MutationObserver(showAll).observe(document.documentElement, { attributeFilter: ["data-theme"] });
    new ResizeObserver(() => views.forEach(one => one.draw())).observe(byId("by-side"));
  }
  function begin() {
    data = JSON.parse(byId("data").textContent);
    byId("by-side").hidden = false;
    ball = makeBall(byId("ball"));
    views = [makePlot(byId("angle"), "angle", 0.01), makePlot(byId("command"), "command", 0.1), ball];
    readAddress();
    showAll();
    listen();
    document.fonts.ready.then(showAll);
  }
  if (byId("by-side")) begin(); // the script is deferred: the page is there
})();
