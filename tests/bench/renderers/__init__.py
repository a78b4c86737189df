"""ramify's path tracer beside Cycles and Mitsuba 3, on scenes of the same triangles: `make bench-renderers`."""
