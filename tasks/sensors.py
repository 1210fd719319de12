"""List the sensors that the model of every task carries."""

# (sensor name, MJCF element, size): n, o, a are the columns of R; omega is in the base frame [rad/s]
SENSORS = (
    ("n", "framexaxis", 3),
    ("o", "frameyaxis", 3),
    ("a", "framezaxis", 3),
    ("omega", "frameangvel", 3),
    ("quat", "framequat", 4),
)


def sensor_xml(site: str) -> str:
    """Return the <sensor> element that every task's model must contain, for the site that is regulated."""
    lines = [f'    <{kind} name="{name}" objtype="site" objname="{site}"/>' for name, kind, _ in SENSORS]
    return "\n".join(["  <sensor>", *lines, "  </sensor>"])
