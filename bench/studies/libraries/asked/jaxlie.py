"""jaxlie: SO3.log in double precision."""

import jax
import jaxlie
import numpy as np

from bench.studies.libraries.library import MATRIX, QUATERNION, Function, Library

jax.config.update("jax_enable_x64", True)

log_of_matrix = jax.jit(lambda R: jaxlie.SO3.from_matrix(R).log())
log_of_quaternion = jax.jit(lambda quat_wxyz: jaxlie.SO3(quat_wxyz).log())
rpy = jax.jit(lambda R: jaxlie.SO3.from_matrix(R).as_rpy_radians())

LIBRARY = Library(
    "jaxlie",
    "jaxlie",
    (
        Function("SO3.from_matrix, log", MATRIX, log_of_matrix),
        Function("SO3.log", QUATERNION, log_of_quaternion),
        Function("SO3.as_rpy_radians", MATRIX, lambda R: np.array(rpy(R)), "z-y-x"),
    ),
)
