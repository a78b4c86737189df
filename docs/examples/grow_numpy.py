"""Grows one object of a scene and measures it with NumPy: python3 grow_numpy.py SCENE OBJECT"""

import sys

import numpy as np
import ramify

file, name = sys.argv[1:]
try:
    tree = ramify.Scene.load(file).grow(name)
except ramify.BadInput as error:
    sys.exit(f"grow_numpy: {error}")
child = np.flatnonzero(tree.parents >= 0)
lengths = np.linalg.norm(tree.positions[child] - tree.positions[tree.parents[child]], axis=1)
tips = len(tree) - len(np.unique(tree.parents[child]))
print(f"{name}: {len(tree)} nodes, {lengths.sum():.2f} m of branches, {tips} tips")
