/* Vectors, quaternions (w, x, y, z) and a fixed eye, for what the live page draws. */
(function (root) {
  "use strict";
  const YAW = 0.6, PITCH = 0.35;

  const cross = (p, q) => [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]];
  const dot = (p, q) => p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
  const scaled = (k, v) => v.map(value => k * value);
  const sum = (...vectors) => vectors.reduce((p, q) => p.map((value, i) => value + q[i]));
  const unit = v => scaled(1 / Math.sqrt(dot(v, v)), v);

  function product(p, q) {
    const [a, ...v] = p, [b, ...w] = q;
    return [a * b - dot(v, w), ...sum(scaled(a, w), scaled(b, v), cross(v, w))];
  }
  const conjugate = ([w, ...v]) => [w, ...scaled(-1, v)];
  function normalized(q) {
    const length = Math.hypot(...q);
    return q.map(value => value / length);
  }
  function about(axis, angle) { // at 180 degrees exactly
    const half = angle / 2;
    return [angle === Math.PI ? 0 : Math.cos(half), ...scaled(Math.sin(half), axis)];
  }
  function rotationVector(q) { // of the shorter way
    const [w, ...v] = q[0] < 0 ? scaled(-1, q) : q, sine = Math.hypot(...v);
    return sine > 0 ? scaled((2 * Math.atan2(sine, w)) / sine, v) : [0, 0, 0];
  }
  const rotate = (R, v) => sum(scaled(v[0], R[0]), scaled(v[1], R[1]), scaled(v[2], R[2]));

  function eye(yaw = YAW, pitch = PITCH) { // unit vectors of the base that point right, up and to the reader
    const [cy, sy, cp, sp] = [Math.cos(yaw), Math.sin(yaw), Math.cos(pitch), Math.sin(pitch)];
    return { right: [cy, -sy, 0], up: [sp * sy, sp * cy, cp], near: [-cp * sy, -cp * cy, sp] };
  }
  root.liveSpace = { cross, dot, scaled, sum, unit, product, conjugate, normalized, about, rotationVector, rotate, eye };
})(window);
