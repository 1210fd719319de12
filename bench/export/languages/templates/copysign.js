function copysign(magnitude, sign) {
    const negative = sign < 0 || Object.is(sign, -0);
    return negative ? -Math.abs(magnitude) : Math.abs(magnitude);
}
