/* A gripper in three dimensions for each law, and its goal as wires. Dragging, or the arrow keys, turn the start. */
(function (root) {
  "use strict";
  const { rotate, eye, dot, cross, sum, scaled, unit, about } = root.liveSpace;
  const LIGHT = unit([0.3, -0.6, 0.9]), STEP = Math.PI / 36, DRAG = 0.008, REACH = 1.32;

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
    let size = 0, held = null;

    const project = p => [size * (0.5 + (0.5 / REACH) * dot(p, right)), size * (0.5 - (0.5 / REACH) * dot(p, up))];
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

    function drawHand(R, colour, alpha, paper) {
      for (const face of facesOf(R)) {
        trace(face.corners.map(project));
        pen.globalAlpha = alpha;
        pen.fillStyle = `color-mix(in srgb, ${colour} ${Math.round(58 + 42 * Math.max(0, dot(face.normal, LIGHT)))}%, ${paper})`;
        pen.fill();
        pen.strokeStyle = paper;
        pen.lineWidth = 0.7;
        pen.stroke();
      }
      pen.globalAlpha = 1;
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
    function draw(goal, hands) { // hands: [{ R, colour, alpha }], the first in front
      const ratio = window.devicePixelRatio || 1, { color: ink, backgroundColor: paper } = getComputedStyle(canvas);
      size = canvas.clientWidth;
      canvas.width = canvas.height = Math.round(size * ratio);
      pen.setTransform(ratio, 0, 0, ratio, 0, 0);
      for (const { R, colour, alpha } of [...hands].reverse()) drawHand(R, colour, alpha, paper);
      drawWires(goal, ink);
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
