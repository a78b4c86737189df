"""Reads a USD file with OpenUSD and holds it against expectations.

usage: usd_check.py FILE [KEY=VALUE[~TOLERANCE]]...

Always: the stage opens without complaint, OpenUSD's ComplianceChecker finds nothing, and every material that is bound
resolves to a UsdPreviewSurface whose inputs have the specified types and whose textures exist. Each KEY is a number
measured on the stage (see measures()); VALUE may be several numbers with commas. TOLERANCE is relative to the value,
or to 1 where the value is less; without one, numbers must be equal. Prints every failure; exits 1 if there is any.
"""
import json
import math
import os
import sys

import numpy
from pxr import Gf, Usd, UsdGeom, UsdLux, UsdShade, UsdUtils

# The wheel comes without the definitions of its shaders, which this rule wants; INPUTS stands in for them.
WITHOUT_DEFINITIONS = "ShaderPropertyTypeConformanceChecker"

# openusd.org/release/spec_usdpreviewsurface.html
INPUTS = {
    "UsdPreviewSurface": {
        "diffuseColor": "color3f", "emissiveColor": "color3f", "useSpecularWorkflow": "int", "metallic": "float",
        "roughness": "float", "opacity": "float", "opacityThreshold": "float", "ior": "float"},
    "UsdUVTexture": {
        "file": "asset", "st": "float2", "wrapS": "token", "wrapT": "token", "scale": "float4",
        "sourceColorSpace": "token"},
    "UsdPrimvarReader_float2": {"varname": "string"},
    "UsdPrimvarReader_float3": {"varname": "string", "fallback": "float3"},
}

failures = []


def fail(*words):
    failures.append(" ".join(str(word) for word in words))


def validate(file, stage):
    checker = UsdUtils.ComplianceChecker(arkit=False)
    checker._rules = [rule for rule in checker._rules if type(rule).__name__ != WITHOUT_DEFINITIONS]
    checker.CheckCompliance(file)
    for word in checker.GetErrors() + checker.GetFailedChecks() + checker.GetWarnings():
        fail("ComplianceChecker:", word)
    if stage.GetCompositionErrors():
        fail("composition:", stage.GetCompositionErrors())


def check_shader(shader):
    types = INPUTS.get(shader.GetShaderId())
    if types is None:
        return fail(shader.GetPath(), "is an unknown shader", shader.GetShaderId())
    for value in shader.GetInputs():
        if types.get(value.GetBaseName()) != str(value.GetTypeName()):
            fail(value.GetAttr().GetPath(), "has the type", value.GetTypeName())
        if value.HasConnectedSource():
            source, name, _ = value.GetConnectedSource()
            if not UsdShade.Shader(source.GetPrim()) or not source.GetOutput(name):
                fail(value.GetAttr().GetPath(), "is connected to nothing")
        asset = value.Get() if str(value.GetTypeName()) == "asset" else None
        if asset is not None and not os.path.isfile(asset.resolvedPath):
            fail(value.GetAttr().GetPath(), "names no file:", asset)


def check_binding(prim):
    material, _ = UsdShade.MaterialBindingAPI(prim).ComputeBoundMaterial()
    surface = material.ComputeSurfaceSource()[0] if material else None
    if not surface or surface.GetShaderId() != "UsdPreviewSurface":
        return fail(prim.GetPath(), "has no material that resolves")
    for shader in material.GetPrim().GetChildren():
        check_shader(UsdShade.Shader(shader))
        name = UsdShade.Shader(shader).GetInput("varname")
        if name and name.Get() in ("displayColor", "emission"):
            primvar = UsdGeom.PrimvarsAPI(prim).GetPrimvar(name.Get())
            if not primvar or not primvar.HasValue():
                fail(prim.GetPath(), "has no", name.Get(), "that its material reads")


def triangles_of(mesh):
    """Positions and mean normals of the corners of a mesh's triangles, as n x 3 x 3 and n x 3."""
    points = numpy.array(mesh.GetPointsAttr().Get(), dtype=float).reshape(-1, 3)
    counts = numpy.array(mesh.GetFaceVertexCountsAttr().Get())
    indices = numpy.array(mesh.GetFaceVertexIndicesAttr().Get())
    if len(counts) == 0:
        return numpy.zeros((0, 3, 3)), None
    if len(set(counts)) != 1 or counts.sum() != len(indices) or indices.max() >= len(points):
        fail(mesh.GetPath(), "has faces that do not fit")
    faces = indices.reshape(len(counts), counts[0])
    corners = faces if counts[0] == 3 else numpy.concatenate([faces[:, [0, 1, 3]], faces[:, [2, 3, 1]]])
    normals = mesh.GetNormalsAttr().Get()
    if normals is not None:
        normals = numpy.array(normals, dtype=float)
        if len(normals) != len(points) or mesh.GetNormalsInterpolation() != "vertex":
            fail(mesh.GetPath(), "has normals that do not fit")
        normals = normals[corners].sum(axis=1)
    return points[corners], normals


class Sums:
    """Measures of all surfaces, each as often as it is seen."""

    def __init__(self):
        self.triangles = 0  # stored
        self.seen_triangles = 0
        self.area = 0.0
        self.volume = 0.0
        self.inward = 0  # triangles that turn their normals' back
        self.segments = 0
        self.low = numpy.full(3, numpy.inf)
        self.high = -self.low

    def widen(self, points, around=0.0):
        if len(points):
            self.low = numpy.minimum(self.low, (points - around).min(axis=0))
            self.high = numpy.maximum(self.high, (points + around).max(axis=0))

    def add_mesh(self, mesh, places):
        corners, normals = triangles_of(mesh)
        self.triangles += len(corners)
        if len(corners) == 0:
            return
        if normals is not None:
            across = numpy.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
            self.inward += int(((across * normals).sum(axis=1) < 0).sum())
        for place in places:
            m = numpy.array(place)
            world = corners @ m[:3, :3] + m[3, :3]
            a, b, c = world[:, 0], world[:, 1], world[:, 2]
            mirrored = -1.0 if numpy.linalg.det(m[:3, :3]) < 0 else 1.0
            self.seen_triangles += len(world)
            self.area += numpy.linalg.norm(numpy.cross(b - a, c - a), axis=1).sum() / 2
            self.volume += mirrored * (a * numpy.cross(b, c)).sum() / 6
            self.widen(world.reshape(-1, 3))

    def add_curves(self, curves, places):
        points = numpy.array(curves.GetPointsAttr().Get(), dtype=float)
        widths = numpy.array(curves.GetWidthsAttr().Get(), dtype=float)
        counts = numpy.array(curves.GetCurveVertexCountsAttr().Get())
        if len(widths) != len(points) or counts.sum() != len(points) or counts.min() < 2:
            fail(curves.GetPath(), "has points that do not fit")
        self.segments += int((counts - 1).sum())
        for place in places:
            m = numpy.array(place)
            self.widen(points @ m[:3, :3] + m[3, :3], widths[:, None] / 2)


def check_extent(prim):
    """The extent that is written is the one that OpenUSD computes."""
    if prim.IsA(UsdGeom.PointInstancer) and len(UsdGeom.PointInstancer(prim).GetProtoIndicesAttr().Get()) == 0:
        return
    boundable = UsdGeom.Boundable(prim)
    written = boundable.GetExtentAttr().Get()
    computed = UsdGeom.Boundable.ComputeExtentFromPlugins(boundable, Usd.TimeCode.Default())
    if written is None or computed is None:
        return fail(prim.GetPath(), "has no extent")
    written, computed = numpy.array(written), numpy.array(computed)
    # instances are turned with the precision of half floats, and OpenUSD takes the widest curve everywhere
    tolerance = 3e-3 if prim.IsA(UsdGeom.PointInstancer) else 1e-5
    size = numpy.linalg.norm(computed[1] - computed[0])
    if prim.IsA(UsdGeom.BasisCurves):
        widest = max(UsdGeom.BasisCurves(prim).GetWidthsAttr().Get())
        inside = (written[0] >= computed[0] - 1e-5).all() and (written[1] <= computed[1] + 1e-5).all()
        if not inside or abs(written - computed).max() > widest:
            fail(prim.GetPath(), "has the extent", written, "instead of", computed)
    elif abs(written - computed).max() > tolerance * size:
        fail(prim.GetPath(), "has the extent", written, "instead of", computed)


def instance_places(stage, instancer):
    cache = UsdGeom.XformCache()
    time = Usd.TimeCode.Default()
    places = instancer.ComputeInstanceTransformsAtTime(time, time, UsdGeom.PointInstancer.ExcludeProtoXform)
    count = len(instancer.GetProtoIndicesAttr().Get())
    variation = UsdGeom.PrimvarsAPI(instancer).GetPrimvar("variation").Get()
    if len(places) != count or len(variation) != count or not all(0 <= v <= 1 for v in variation):
        fail(instancer.GetPath(), "has arrays that do not fit")
    if [str(path) for path in instancer.GetPrototypesRel().GetTargets()] != [f"{instancer.GetPath()}/Prototype"]:
        fail(instancer.GetPath(), "has no prototype")
    return [place * cache.GetLocalToWorldTransform(instancer.GetPrim()) for place in places]


def measure_surfaces(stage):
    sums, instances, meshes = Sums(), 0, 0
    cache = UsdGeom.XformCache()
    walk = iter(Usd.PrimRange(stage.GetPseudoRoot(), Usd.TraverseInstanceProxies()))
    for prim in walk:
        surfaces, places = [], [cache.GetLocalToWorldTransform(prim)]
        if prim.IsA(UsdGeom.PointInstancer):
            check_extent(prim)
            places = instance_places(stage, UsdGeom.PointInstancer(prim))
            surfaces = [child for child in Usd.PrimRange(prim) if child.IsA(UsdGeom.Gprim)]
            instances += len(places)
            walk.PruneChildren()
        elif prim.IsA(UsdGeom.Gprim):
            surfaces = [prim]
            instances += prim.IsInstanceProxy()
        for surface in surfaces:
            check_binding(surface)
            check_extent(surface)
            meshes += surface.IsA(UsdGeom.Mesh)
            if surface.IsA(UsdGeom.Mesh):
                sums.add_mesh(UsdGeom.Mesh(surface), places)
            else:
                sums.add_curves(UsdGeom.BasisCurves(surface), places)
    return sums, instances, meshes


def camera_measures(stage):
    prim = next(prim for prim in stage.Traverse() if prim.IsA(UsdGeom.Camera))
    camera = UsdGeom.Camera(prim).GetCamera(Usd.TimeCode.Default())
    frustum = camera.frustum
    window = frustum.GetWindow()
    return {
        "fov": camera.GetFieldOfView(Gf.Camera.FOVVertical),
        "aspect": camera.aspectRatio,
        "eye": list(frustum.GetPosition()),
        "view": list(frustum.ComputeViewDirection()),
        "shift": [(window.GetMin()[i] + window.GetMax()[i]) / 2 / window.GetSize()[1] for i in (0, 1)],
        "focus": camera.focusDistance,
        "far": camera.clippingRange.max,
        "lens": camera.focalLength * Gf.Camera.FOCAL_LENGTH_UNIT / camera.fStop if camera.fStop > 0 else 0,
    }


def light_measures(stage):
    lights = {}
    cache = UsdGeom.XformCache()
    for prim in stage.Traverse():
        if not prim.HasAPI(UsdLux.LightAPI):
            continue
        light = UsdLux.LightAPI(prim)
        strength = light.GetIntensityAttr().Get()
        place = cache.GetLocalToWorldTransform(prim)
        name = prim.GetName()
        lights[name] = [strength * c for c in light.GetColorAttr().Get()]
        lights[name + ".at"] = list(place.Transform(Gf.Vec3d(0, 0, 0)))
        lights[name + ".shines"] = list(place.TransformDir(Gf.Vec3d(0, 0, -1)))
        if prim.IsA(UsdLux.RectLight):
            rect = UsdLux.RectLight(prim)
            lights[name + ".area"] = rect.GetWidthAttr().Get() * rect.GetHeightAttr().Get()
        elif prim.IsA(UsdLux.SphereLight):
            lights[name + ".radius"] = UsdLux.SphereLight(prim).GetRadiusAttr().Get()
        elif prim.IsA(UsdLux.DistantLight):
            lights[name + ".angle"] = UsdLux.DistantLight(prim).GetAngleAttr().Get()
            if not light.GetNormalizeAttr().Get():
                fail(prim.GetPath(), "is not normalised")
        elif prim.IsA(UsdLux.DomeLight):
            picture = UsdLux.DomeLight(prim).GetTextureFileAttr().Get()
            lights[name + ".pictures"] = 0 if picture is None else 1
            if picture is not None and not os.path.isfile(picture.resolvedPath):
                fail(prim.GetPath(), "names no file:", picture)
    return lights


def measures(stage):
    sums, instances, meshes = measure_surfaces(stage)
    found = {
        "meshes": meshes, "instances": instances, "triangles": sums.triangles, "segments": sums.segments,
        "seen_triangles": sums.seen_triangles, "area": sums.area, "volume": sums.volume, "inward": sums.inward,
        "low": list(sums.low), "high": list(sums.high),
    }
    found.update(camera_measures(stage))
    found.update(light_measures(stage))
    return found


def as_list(value):
    return [float(x) for x in (value if isinstance(value, list) else [value])]


def compare(found, expectation):
    key, _, value = expectation.partition("=")
    value, _, tolerance = value.partition("~")
    want = [float(x) for x in value.split(",")]
    if key not in found:
        return fail("there is no", key)
    have = as_list(found[key])
    scale = max(1.0, max(abs(x) for x in want))
    if len(have) != len(want) or max(abs(a - b) for a, b in zip(have, want)) > float(tolerance or 0) * scale:
        fail(key, "is", have, "instead of", want)


def main():
    file, expectations = sys.argv[1], sys.argv[2:]
    stage = Usd.Stage.Open(file)
    if stage.GetDefaultPrim().GetPath() != "/World" or UsdGeom.GetStageUpAxis(stage) != "Y":
        fail("the stage's metadata are wrong")
    if UsdGeom.GetStageMetersPerUnit(stage) != 1.0:
        fail("the unit is not the metre")
    validate(file, stage)
    found = measures(stage)
    for expectation in expectations:
        compare(found, expectation)
    if not expectations:
        print(json.dumps(found, indent=1))
    for words in failures:
        print(words)
    sys.exit(1 if failures else 0)


main()
