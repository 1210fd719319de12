void {name}_batch(const double *rows, double *answers, long count) {{
    long k;
    for (k = 0; k < count; k++) {{
        const double *s = rows + {width} * k;
        double *answer = answers + {answers} * k;
        {first}
        {name}_angular_acceleration(s, s + 9, s + 12, {gains}, {state}answer);
        {last}
    }}
}}
