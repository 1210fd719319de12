"""Debian's libraries in C++, compiled here: most controllers in C++ are written on Eigen; KDL and tf2 are ROS's."""

import ctypes
import functools
import shutil
import subprocess
import tempfile
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np

from bench.studies.libraries.library import MATRIX, QUATERNION, Function, Tested, library, vector_part

SOURCES = Path(__file__).parent / "cpp"
NUMBERS = ctypes.POINTER(ctypes.c_double)
OF_KDL = ("kdl", "-I/usr/include/eigen3", "-lorocos-kdl")


@library("libeigen3-dev", is_debian=True)
def eigen() -> Iterator[Tested]:
    """Yield Eigen's angle times axis, a vector part and its Euler angles."""
    made = compiled("eigen", "-I/usr/include/eigen3")
    yield Function("AngleAxisd, of a matrix", MATRIX, made("angle_axis_of_matrix"))
    yield Function("AngleAxisd, of a quaternion", QUATERNION, made("angle_axis_of_quaternion"))
    yield vector_part("Quaterniond", made("vector_part_of_matrix"), "`AngleAxisd`")
    yield Function("eulerAngles(2, 1, 0)", MATRIX, made("euler_angles"), "z-y-x")


@library("liborocos-kdl-dev", is_debian=True)
def kdl() -> Iterator[Tested]:
    """Yield the rotation vectors of KDL's Rotation, its difference, a vector part and its angles."""
    made = compiled(*OF_KDL)
    thread = "orocos/orocos_kinematics_dynamics#352"
    yield Function("Rotation::GetRot", MATRIX, made("get_rot"), thread=thread)
    yield Function("Rotation::GetRotAngle", MATRIX, made("get_rot_angle"), thread=thread)
    yield Function("diff", MATRIX, made("diff"), thread=thread)
    yield Function("Rotation::Quaternion, GetRot", QUATERNION, made("of_quaternion"), thread=thread)
    yield vector_part("GetQuaternion", made("get_quaternion"), "`-q` where w < 0")
    yield Function("Rotation::GetRPY", MATRIX, made("get_rpy"), "z-y-x")


@library("libtf2-dev", is_debian=True, note="Debian's package, which is that of ROS 1")
def tf2() -> Iterator[Tested]:
    """Yield what users of tf2 multiply for a rotation vector, and its angles."""
    made = compiled("tf2", "-I/usr/include/console_bridge")

    def idiom(name: str, takes: str, word: str) -> Function:
        return Function(name, takes, made(word), kind="idiom", fix="`-q` where `q.w() < 0`, before it")

    yield idiom("Quaternion: getAngle * getAxis", QUATERNION, "angle_axis")
    yield idiom("Quaternion: getAngleShortestPath * getAxis", QUATERNION, "shortest_path")
    yield idiom("Matrix3x3::getRotation: getAngle * getAxis", MATRIX, "angle_axis_of_matrix")
    yield Function("Matrix3x3::getRPY", MATRIX, made("get_rpy"), "z-y-x", thread="ros/geometry2#504")


@functools.cache
def compiled(name: str, *options: str) -> Callable[[str], Callable]:
    """Compile cpp/NAME.cpp and return: name of a function -> call(array of doubles) -> three numbers."""
    compiler = shutil.which("c++")
    if compiler is None:
        raise ImportError("no C++ compiler; install g++")
    with tempfile.TemporaryDirectory(prefix="orientation-bench-") as place:
        made = Path(place) / name
        command = [compiler, "-O2", "-shared", "-fPIC", "-std=c++17", str(SOURCES / f"{name}.cpp"), "-o", str(made)]
        done = subprocess.run([*command, *options], capture_output=True, text=True, check=False)
        if done.returncode:
            reason = next((line for line in done.stderr.splitlines() if "error:" in line), "no reason given")
            raise ImportError(f"{name}.cpp: {reason.rpartition('error: ')[2]}")
        library = ctypes.CDLL(str(made))

    def function(word: str) -> Callable:
        called = getattr(library, word)
        called.argtypes, called.restype = (NUMBERS, NUMBERS), None

        def call(value: np.ndarray) -> np.ndarray:
            value, e = np.ascontiguousarray(value, dtype=float), np.full(3, np.nan)
            called(value.ctypes.data_as(NUMBERS), e.ctypes.data_as(NUMBERS))
            return e

        return call

    return function


SMALL_EPS = Function("GetRotAngle, eps 1e-9", MATRIX, lambda R: compiled(*OF_KDL)("get_rot_angle_with_small_eps")(R))
"""The function of KDL that a patch fixes; it is not in the tables, where eps is KDL's own."""
