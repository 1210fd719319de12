void columns(const double R[9], const double R_d[9], double e[3]) {
    for (int k = 0; k < 3; k++) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        e[k] = 0.0;
        for (int c = 0; c < 3; c++) e[k] += 0.5 * (R[3 * i + c] * R_d[3 * j + c] - R[3 * j + c] * R_d[3 * i + c]);
    }
}

/* xyzw; no sign */
void vector_part(const double q[4], const double p[4], double e[3]) {
    for (int k = 0; k < 3; k++) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        e[k] = 2.0 * (q[3] * p[k] - p[3] * q[k] - (p[i] * q[j] - p[j] * q[i]));
    }
}

void lazy(const double R[9], const double R_d[9], double e[3]) { e[0] = R[0]; }

void floats(const float R[9], const float R_d[9], float e[3]) {
    for (int k = 0; k < 3; k++) e[k] = R[k] - R_d[k];
}

void error_first(double e[3], const double R[9], const double R_d[9]) { columns(R, R_d, e); }

void beyond(const double R[9], const double R_d[9], double e[3]) {
    columns(R, R_d, e);
    e[3] = 0.0;
}
