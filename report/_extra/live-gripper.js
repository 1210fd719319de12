/* A gripper in three dimensions for each law, beside or above each other as the canvas is wide or high: its goal as wires,
   the axes of its body, and the axis of the rotation that is left. Dragging, or the arrow keys, turn the start. */
(function (root) {
  "use strict";
  const { rotate, eye, dot, cross, sum, scaled, unit, about } = root.liveSpace;
  const LIGHT = unit([0.3, -0.6, 0.9]), STEP = Math.PI / 36, DRAG = 0.008, REACH = 1.2, AXIS_LENGTH = 0.95, AXIS_REACH = 1.15;

  function box([x0, x1], [y0, y1], [z0, z1]) { // six faces, their corners counter-clockwise from outside
    const at = (i, j, k) => [[x0, x1][i], [y0, y1][j], [z0, z1][k]];
    return [
      [at(0, 0, 0), at(0, 1, 0), at(1, 1, 0), at(1, 0, 0)], [at(0, 0, 1), at(1, 0, 1), at(1, 1, 1), at(0, 1, 1)],
      [at(0, 0, 0), at(1, 0, 0), at(1, 0, 1), at(0, 0, 1)], [at(0, 1, 0), at(0, 1, 1), at(1, 1, 1), at(1, 1, 0)],
      [at(0, 0, 0), at(0, 0, 1), at(0, 1, 1), at(0, 1, 0)], [at(1, 0, 0), at(1, 1, 0), at(1, 1, 1), at(1, 0, 1)],
    ];
  }
  // z points out of the hand, y from finger to finger; a knob on x tells its two sides apart
  const WRIST = box([-0.2, 0.2], [-0.2, 0.2], [-0.75, -0.35]), PALM = box([-0.24, 0.24], [-0.62, 0.62], [-0.35, 0]);
  const FINGERS = [box([-0.13, 0.13], [-0.6, -0.36], [0, 0.72]), box([-0.13, 0.13], [0.36, 0.6], [0, 0.72])];
  const KNOB = box([0.24, 0.42], [-0.14, 0.14], [-0.27, -0.08]);

  function farthestFirst(R, near) { // planes across the hand part its boxes, so that an order of them is exact
    const [x, y, z] = R.map(axis => dot(axis, near) > 0);
    const fingers = y ? FINGERS : [...FINGERS].reverse(), palm = x ? [PALM, KNOB] : [KNOB, PALM];
    return (z ? [WRIST, ...palm, ...fingers] : [...fingers, ...palm, WRIST]).flat();
  }

  function make(canvas, handlers) {
    const pen = canvas.getContext("2d"), { right, up, near } = eye();
    let size = 0, centre = [0, 0], held = null;

    const project = p => [centre[0] + (size / REACH / 2) * dot(p, right), centre[1] - (size / REACH / 2) * dot(p, up)];
    function trace(points) {
      pen.beginPath();
      points.forEach((p, i) => (i ? pen.lineTo(...p) : pen.moveTo(...p)));
      pen.closePath();
    }
    function facesOf(R) {
      return farthestFirst(R, near).map(face => face.map(corner => rotate(R, corner)))
        .map(corners => ({ corners, normal: normalOf(corners) }))
        .filter(face => dot(face.normal, near) > 0);
    }
    const normalOf = ([a, b, c]) => unit(cross(sum(b, scaled(-1, a)), sum(c, scaled(-1, b))));

    function drawHand(R, colour, paper) {
      for (const face of facesOf(R)) {
        trace(face.corners.map(project));
        pen.fillStyle = `color-mix(in srgb, ${colour} ${Math.round(58 + 42 * Math.max(0, dot(face.normal, LIGHT)))}%, ${paper})`;
        pen.fill();
        pen.strokeStyle = paper;
        pen.lineWidth = 0.7;
        pen.stroke();
      }
    }
    function drawLine(from, to, colour, width, dashes = []) {
      pen.beginPath();
      pen.moveTo(...project(from));
      pen.lineTo(...project(to));
      pen.setLineDash(dashes);
      Object.assign(pen, { strokeStyle: colour, lineWidth: width });
      pen.stroke();
      pen.setLineDash([]);
    }
    function drawAxes(R, ink) {
      R.forEach((axis, i) => {
        drawLine([0, 0, 0], scaled(AXIS_LENGTH, axis), ink, 1.2);
        pen.fillText("xyz"[i], ...project(scaled(AXIS_LENGTH + 0.12, axis)));
      });
    }
    function drawWires(R, ink) {
      pen.strokeStyle = ink;
      pen.lineWidth = 1;
      pen.setLineDash([3, 3]);
      pen.globalAlpha = 0.65;
      for (const face of facesOf(R)) { trace(face.corners.map(project)); pen.stroke(); }
      pen.globalAlpha = 1;
      pen.setLineDash([]);
    }
    function draw(goal, hands) { // hands: [{ R, colour, axis, name }]
      const ratio = window.devicePixelRatio || 1, { color: ink, backgroundColor: paper } = getComputedStyle(canvas);
      const [width, height] = [canvas.clientWidth, canvas.clientHeight], isWide = width > height;
      [canvas.width, canvas.height] = [width, height].map(value => Math.round(value * ratio));
      pen.setTransform(ratio, 0, 0, ratio, 0, 0);
      size = isWide ? Math.min(height, width / 2) : Math.min(width, height / 2);
      hands.forEach(({ R, colour, axis, name }, i) => {
        centre = isWide ? [width * (0.25 + 0.5 * i), height / 2] : [width / 2, height * (0.25 + 0.5 * i)];
        Object.assign(pen, { font: "600 13px 'Orientation Sans', sans-serif", textAlign: "center", textBaseline: "middle" });
        if (axis) drawLine(scaled(-AXIS_REACH, axis), scaled(AXIS_REACH, axis), colour, 1.6, [9, 3, 2, 3]);
        drawHand(R, colour, paper);
        drawWires(goal, ink);
        pen.fillStyle = ink;
        drawAxes(R, ink);
        pen.textAlign = "left";
        pen.fillText(name, isWide ? 0.5 * width * i + 10 : 10, isWide ? 14 : 0.5 * height * i + 14);
      });
    }
    function turn(across, down) { handlers.turn([about(up, across), about(right, down)]); }

    canvas.addEventListener("pointerdown", event => {
      held = [event.clientX, event.clientY];
      canvas.setPointerCapture(event.pointerId);
    });
    canvas.addEventListener("pointermove", event => {
      if (!held) return;
      turn(DRAG * (event.clientX - held[0]), DRAG * (event.clientY - held[1]));
      held = [event.clientX, event.clientY];
    });
    for (const end of ["pointerup", "pointercancel"]) canvas.addEventListener(end, () => { held = null; });
    canvas.addEventListener("keydown", event => {
      const ways = { ArrowLeft: [-STEP, 0], ArrowRight: [STEP, 0], ArrowUp: [0, -STEP], ArrowDown: [0, STEP] };
      const roll = { PageUp: STEP, PageDown: -STEP }[event.key];
      if (!ways[event.key] && !roll) return;
      event.preventDefault();
      if (roll) handlers.turn([about(near, roll)]);
      else turn(...ways[event.key]);
    });
    return { draw };
  }
  root.liveGripper = { make };
})(window);
