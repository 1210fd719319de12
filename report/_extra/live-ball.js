/* The ball of rotation vectors: direction is the axis of the turn to go, distance from the centre its angle, and 180
   degrees are the surface, where a way leaves and goes on at the opposite point. Drag, or the arrow keys, turn it. */
(function (root) {
  "use strict";
  const { dot, scaled, eye } = root.liveSpace;
  const PITCH = 0.35, ASIDE = 0.5, STEP = 0.12, CIRCLE = 96, BEHIND = 0.45, RADIUS = 0.43;
  const ring = f => Array.from({ length: CIRCLE + 1 }, (_, i) => f((2 * Math.PI * i) / CIRCLE));
  const RINGS = [ring(t => [Math.cos(t), Math.sin(t), 0]), ring(t => [Math.cos(t), 0, Math.sin(t)]),
                 ring(t => [0, Math.cos(t), Math.sin(t)])];
  const AXES = { x: [1, 0, 0], y: [0, 1, 0], z: [0, 0, 1] };
  const isJump = (p, q) => Math.hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]) > 1;

  function make(canvas) {
    const pen = canvas.getContext("2d");
    let yaw = 0, pitch = PITCH, held = null, size = 0, ways = [];

    function project(p) {
      const { right, up, near } = eye(yaw, pitch);
      return [size * (0.5 + RADIUS * dot(p, right)), size * (0.5 - RADIUS * dot(p, up)), dot(p, near)];
    }
    function line(points, colour, width, dashes = []) {
      const spots = points.map(project);
      Object.assign(pen, { strokeStyle: colour, lineWidth: width });
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
      Object.assign(pen, { strokeStyle: rule, lineWidth: 1 });
      pen.beginPath();
      pen.arc(size / 2, size / 2, RADIUS * size, 0, 7);
      pen.stroke();
      for (const points of RINGS) line(points, rule, 1);
      Object.assign(pen, { fillStyle: ink, font: "600 14px 'Orientation Sans', sans-serif", textAlign: "center" });
      for (const [name, tip] of Object.entries(AXES)) {
        const [x, y, depth] = project(scaled(1.08, tip));
        pen.globalAlpha = depth > -0.2 ? 1 : 0.45;
        pen.fillText(name, x, y + 5);
      }
      pen.globalAlpha = 1;
      Object.assign(pen, { strokeStyle: ink, lineWidth: 1.5 });
      pen.beginPath(); // the goal
      pen.moveTo(size / 2 - 6, size / 2); pen.lineTo(size / 2 + 6, size / 2);
      pen.moveTo(size / 2, size / 2 - 6); pen.lineTo(size / 2, size / 2 + 6);
      pen.stroke();
    }
    function drawSpot([x, y], isRound, colour, paper) {
      pen.beginPath();
      if (isRound) pen.arc(x, y, 6, 0, 7);
      else pen.rect(x - 5, y - 5, 10, 10);
      Object.assign(pen, { fillStyle: colour, strokeStyle: paper, lineWidth: 1.5 });
      pen.fill();
      pen.stroke();
    }
    function draw(given = ways) { // ways: [{ points, now, colour, dashes }], rotation vectors over pi
      ways = given;
      const ratio = window.devicePixelRatio || 1, style = getComputedStyle(canvas);
      size = canvas.clientWidth;
      canvas.width = canvas.height = Math.round(size * ratio);
      pen.setTransform(ratio, 0, 0, ratio, 0, 0);
      drawFrame(style.color, style.borderTopColor);
      ways.forEach(({ points, now, colour, dashes }, i) => {
        line(points, colour, 2.2, dashes);
        drawSpot(project(now), i === 0, colour, style.backgroundColor);
      });
    }
    function face(first) { // so that the way from the start to the goal is seen from the side
      yaw = Math.atan2(-first[1], first[0]) - ASIDE;
      pitch = PITCH;
    }
    function turn(dx, dy) {
      yaw += dx;
      pitch = Math.max(-1.5, Math.min(1.5, pitch + dy));
      draw();
    }
    canvas.addEventListener("pointerdown", event => {
      held = [event.clientX, event.clientY];
      canvas.setPointerCapture(event.pointerId);
    });
    canvas.addEventListener("pointermove", event => {
      if (!held) return;
      turn((event.clientX - held[0]) / 150, (event.clientY - held[1]) / 150);
      held = [event.clientX, event.clientY];
    });
    for (const end of ["pointerup", "pointercancel"]) canvas.addEventListener(end, () => { held = null; });
    canvas.addEventListener("keydown", event => {
      const way = { ArrowLeft: [-STEP, 0], ArrowRight: [STEP, 0], ArrowUp: [0, -STEP], ArrowDown: [0, STEP] }[event.key];
      if (!way) return;
      event.preventDefault();
      turn(...way);
    });
    return { draw, face };
  }
  root.liveBall = { make };
})(window);
