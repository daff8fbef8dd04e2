"""Rotations and directions by angle."""
import math


def about_y(degrees):
    half = math.radians(degrees) / 2
    return (0, math.sin(half), 0, math.cos(half))


def direction(azimuth, elevation):
    """Degrees; azimuth 0 is +Z, towards the camera of most scenes, and 90 is +X."""
    a, e = math.radians(azimuth), math.radians(elevation)
    return (math.cos(e) * math.sin(a), math.sin(e), math.cos(e) * math.cos(a))
