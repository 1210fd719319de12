/* The ball of rotation vectors: direction is the axis of a rotation, distance from the centre its angle, and 180 degrees
   are the surface. Mouse, finger and arrow keys turn it; shift and arrow keys move a ring from dot to dot, and enter picks the
   dot in the ring, which is there while the canvas has the focus of the keyboard. It follows light and dark.

   ball.make(canvas, { onPick, onMark }) -> { draw({ dots, ways, cut, isSolid, tip }), face(point) }
     dots  [{ at, colour, radius }] in the unit ball; ways  [{ points, now, colour, dashes }]; cut  depth beyond which
     dots are left out, 1 is towards the reader; isSolid  dots hide what is inside; onPick(i)  a dot was clicked;
     onMark(i)  the ring is around another dot, or null */
(function (root) {
  "use strict";
  const START = { yaw: 0.6, pitch: 0.35 }, ASIDE = 0.5, STEP = 0.12, CIRCLE = 96, BEHIND = 0.45, RADIUS = 0.43, STILL = 5;
  const RING = { x: 0, y: -0.28 }, RING_STEP = 0.04, RING_REACH = 0.42; // from the middle, as shares of the canvas
  const LAYER = 0.25, SHELL = 0.78;
  const dot = (p, q) => p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
  const ring = f => Array.from({ length: CIRCLE + 1 }, (_, i) => f((2 * Math.PI * i) / CIRCLE));
  const RINGS = [ring(t => [Math.cos(t), Math.sin(t), 0]), ring(t => [Math.cos(t), 0, Math.sin(t)]),
                 ring(t => [0, Math.cos(t), Math.sin(t)])];
  const AXES = { x: [1, 0, 0], y: [0, 1, 0], z: [0, 0, 1] };
  const isJump = (p, q) => Math.hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]) > 1;

  function make(canvas, { onPick = () => {}, onMark = () => {} } = {}) {
    const pen = canvas.getContext("2d"), sprites = new Map();
    let { yaw, pitch } = START, held = null, size = 0, ratio = 1, waiting = null, ink = "", paper = "";
    let shown = { dots: [], ways: [], cut: 1, tip: name => name }, order = [], spots = [];
    let place = { ...RING }, marked = null;

    function eye() { // unit vectors that point right, up and to the reader
      const [cy, sy, cp, sp] = [Math.cos(yaw), Math.sin(yaw), Math.cos(pitch), Math.sin(pitch)];
      return { right: [cy, -sy, 0], up: [sp * sy, sp * cy, cp], near: [-cp * sy, -cp * cy, sp] };
    }
    function projector() {
      const { right, up, near } = eye();
      return p => [size * (0.5 + RADIUS * dot(p, right)), size * (0.5 - RADIUS * dot(p, up)), dot(p, near)];
    }
    function spriteOf(colour, radius) { // a small ball, drawn once and copied
      const key = `${colour} ${radius} ${ratio} ${paper}`;
      if (!sprites.has(key)) {
        const side = Math.ceil(2 * (radius + 1) * ratio), made = document.createElement("canvas");
        made.width = made.height = side;
        const own = made.getContext("2d");
        own.scale(ratio, ratio);
        own.arc(radius + 1, radius + 1, radius, 0, 7);
        Object.assign(own, { fillStyle: colour, strokeStyle: `color-mix(in srgb, ${colour} 60%, ${paper})`, lineWidth: 0.8 });
        own.fill();
        own.stroke();
        sprites.set(key, made);
      }
      return sprites.get(key);
    }
    function drawDots(project) {
      const { dots, cut, isSolid } = shown;
      spots = dots.map(one => project(one.at));
      const isBared = i => spots[i][2] > cut - LAYER || (spots[i][2] > -LAYER && dot(dots[i].at, dots[i].at) > SHELL ** 2);
      order = dots.map((_, i) => i).filter(i => dots[i].colour && spots[i][2] <= cut && (!isSolid || isBared(i)));
      order.sort((i, j) => spots[i][2] - spots[j][2]);
      for (const i of order) {
        const { colour, radius = 0.005 } = dots[i], pixels = Math.max(1.6, radius * size), half = pixels + 1;
        pen.drawImage(spriteOf(colour, pixels), spots[i][0] - half, spots[i][1] - half, 2 * half, 2 * half);
      }
    }
    function line(project, points, colour, width, dashes = []) {
      const at = points.map(project);
      Object.assign(pen, { strokeStyle: colour, lineWidth: width });
      pen.setLineDash(dashes);
      for (const isNear of [false, true]) { // what lies behind first, and paler
        let isDown = false; // as long as it can be, so that dashes go on
        pen.globalAlpha = isNear ? 1 : BEHIND;
        pen.beginPath();
        for (let i = 1; i < points.length; i++) {
          const isDrawn = (at[i][2] >= 0) === isNear && !isJump(points[i - 1], points[i]);
          if (isDrawn && !isDown) pen.moveTo(at[i - 1][0], at[i - 1][1]);
          if (isDrawn) pen.lineTo(at[i][0], at[i][1]);
          isDown = isDrawn;
        }
        pen.stroke();
      }
      pen.globalAlpha = 1;
      pen.setLineDash([]);
    }
    function drawFrame(project, rule) {
      Object.assign(pen, { strokeStyle: rule, lineWidth: 1 });
      pen.beginPath();
      pen.arc(size / 2, size / 2, RADIUS * size, 0, 7);
      pen.stroke();
      for (const points of RINGS) line(project, points, rule, 1);
    }
    function drawNames(project) {
      Object.assign(pen, { fillStyle: ink, font: "600 14px 'Orientation Sans', sans-serif", textAlign: "center" });
      for (const [name, tip] of Object.entries(AXES)) {
        const [x, y, depth] = project(tip.map(value => 1.1 * value));
        pen.globalAlpha = depth > -0.2 ? 1 : 0.45;
        pen.fillText(shown.tip(name), x, y + 5);
      }
      pen.globalAlpha = 1;
    }
    function drawWay(project, { points, now, colour, dashes }, isRound) {
      line(project, points, paper, 5);
      line(project, points, colour, 2.4, dashes);
      const [x, y] = project(now);
      pen.beginPath();
      if (isRound) pen.arc(x, y, 6, 0, 7);
      else pen.rect(x - 5, y - 5, 10, 10);
      Object.assign(pen, { fillStyle: colour, strokeStyle: paper, lineWidth: 1.5 });
      pen.fill();
      pen.stroke();
    }
    function nearestToRing() { // of the dots that are drawn; null where there is none
      const x = size * (0.5 + place.x), y = size * (0.5 + place.y), distance = i => Math.hypot(spots[i][0] - x, spots[i][1] - y);
      return order.length ? order.reduce((best, i) => (distance(i) <= distance(best) ? i : best)) : null;
    }
    function drawRing() {
      const found = canvas.matches(":focus-visible") ? nearestToRing() : null;
      if (found !== marked) { marked = found; onMark(marked); }
      if (marked === null) return;
      for (const [colour, lineWidth] of [[paper, 6], [ink, 3]]) {
        pen.beginPath();
        pen.arc(spots[marked][0], spots[marked][1], 11, 0, 7);
        Object.assign(pen, { strokeStyle: colour, lineWidth });
        pen.stroke();
      }
    }
    function moveRing(dx, dy) {
      const within = value => Math.max(-RING_REACH, Math.min(RING_REACH, value));
      place = { x: within(place.x + dx), y: within(place.y + dy) };
      draw();
    }
    function paint() {
      waiting = null;
      const style = getComputedStyle(canvas), width = Math.round(canvas.clientWidth * (window.devicePixelRatio || 1));
      [ink, paper, ratio, size] = [style.color, style.backgroundColor, window.devicePixelRatio || 1, canvas.clientWidth];
      if (canvas.width !== width) canvas.width = canvas.height = width;
      pen.setTransform(ratio, 0, 0, ratio, 0, 0);
      pen.clearRect(0, 0, size, size);
      const project = projector();
      drawFrame(project, `color-mix(in srgb, ${ink} 38%, transparent)`);
      drawDots(project);
      drawNames(project);
      shown.ways.forEach((way, i) => drawWay(project, way, i === 0));
      drawRing();
    }
    function draw(given = {}) { // once a frame, however often it is asked
      Object.assign(shown, given);
      if (waiting === null) waiting = requestAnimationFrame(paint);
    }
    function face(point) { // so that the way from the start to the goal is seen from the side
      ({ pitch } = START);
      yaw = Math.atan2(-point[1], point[0]) - ASIDE;
      draw();
    }
    function turn(dx, dy) {
      yaw += dx;
      pitch = Math.max(-1.5, Math.min(1.5, pitch + dy));
      draw();
    }
    function pick(event) { // the foremost dot under the pointer
      const box = canvas.getBoundingClientRect(), x = event.clientX - box.left, y = event.clientY - box.top;
      const near = i => Math.hypot(spots[i][0] - x, spots[i][1] - y) <= Math.max(8, shown.dots[i].radius * size);
      const found = order.findLast(near);
      if (found !== undefined) onPick(found);
    }
    canvas.addEventListener("pointerdown", event => {
      held = { at: [event.clientX, event.clientY], moved: 0 };
      canvas.setPointerCapture(event.pointerId);
    });
    canvas.addEventListener("pointermove", event => {
      if (!held) return;
      const [dx, dy] = [event.clientX - held.at[0], event.clientY - held.at[1]];
      turn(dx / 150, dy / 150);
      held = { at: [event.clientX, event.clientY], moved: held.moved + Math.hypot(dx, dy) };
    });
    canvas.addEventListener("pointerup", event => { if (held && held.moved < STILL) pick(event); held = null; });
    canvas.addEventListener("pointercancel", () => { held = null; });
    canvas.addEventListener("dblclick", () => { ({ yaw, pitch } = START); draw(); });
    canvas.addEventListener("keydown", event => {
      const isPick = event.key === "Enter" || event.key === " ";
      const way = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[event.key];
      if (!way && !isPick) return;
      event.preventDefault();
      if (isPick && marked !== null) onPick(marked);
      if (way && event.shiftKey) moveRing(...way.map(one => one * RING_STEP));
      else if (way) turn(...way.map(one => one * STEP));
    });
    for (const change of ["focus", "blur"]) canvas.addEventListener(change, () => draw());
    new ResizeObserver(() => draw()).observe(canvas);
    document.fonts.ready.then(() => draw());
    return { draw, face };
  }

  root.ball = { make };
})(window);
