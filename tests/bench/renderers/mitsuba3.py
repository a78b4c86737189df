"""Mitsuba 3, its LLVM variant; loaded by renderers.worker. DRJIT_LIBLLVM_PATH names LLVM's library."""

import os
import time

import drjit as dr
import mitsuba as mi
import numpy as np

mi.set_variant("llvm_ad_rgb")

from .scenes import LEAF_UNDERSIDE  # noqa: E402
from .worker import Drawing  # noqa: E402

SAMPLES_AT_ONCE = 64  # bounds the memory of a wavefront
ROULETTE_DEPTH = 5  # Mitsuba's default


class ThinLeaf(mi.BSDF):
    """A sheet that reflects and transmits diffusely, its underside more than its upper side."""

    def __init__(self, properties):
        super().__init__(properties)
        self.upper = properties["upper"]
        self.lower = properties["lower"]
        self.through = properties["through"]
        sides = mi.BSDFFlags.FrontSide | mi.BSDFFlags.BackSide
        self.m_components = [mi.BSDFFlags.DiffuseReflection | sides, mi.BSDFFlags.DiffuseTransmission | sides]
        self.m_flags = self.m_components[0] | self.m_components[1]

    def reflectance(self, cosine):
        return dr.select(cosine > 0.0, mi.Float(self.upper), mi.Float(self.lower))

    def share_reflected(self, cosine):
        """Of all that leaves the sheet."""
        reflected = self.reflectance(cosine)
        return reflected / (reflected + self.through)

    def sample(self, ctx, si, sample1, sample2, active=True):
        cosine = mi.Frame3f.cos_theta(si.wi)
        share = self.share_reflected(cosine)
        reflects = sample1 < share
        upward = reflects == (cosine > 0.0)
        wo = mi.warp.square_to_cosine_hemisphere(sample2)
        result = mi.BSDFSample3f()
        result.pdf = mi.warp.square_to_cosine_hemisphere_pdf(wo) * dr.select(reflects, share, 1.0 - share)
        result.wo = mi.Vector3f(wo.x, wo.y, dr.select(upward, wo.z, -wo.z))
        result.eta = 1.0
        result.sampled_component = dr.select(reflects, mi.UInt32(0), mi.UInt32(1))
        result.sampled_type = dr.select(
            reflects, mi.UInt32(+mi.BSDFFlags.DiffuseReflection), mi.UInt32(+mi.BSDFFlags.DiffuseTransmission)
        )
        valid = active & (result.pdf > 0.0) & (cosine != 0.0)
        return result, dr.select(valid, mi.Spectrum(self.reflectance(cosine) + self.through), 0.0)

    def eval_pdf(self, ctx, si, wo, active=True):
        cos_in, cos_out = mi.Frame3f.cos_theta(si.wi), mi.Frame3f.cos_theta(wo)
        reflects, lobe = cos_in * cos_out > 0.0, dr.abs(cos_out) * dr.inv_pi
        share = self.share_reflected(cos_in)
        value = dr.select(reflects, self.reflectance(cos_in), self.through) * lobe
        density = dr.select(reflects, share, 1.0 - share) * lobe
        return dr.select(active, mi.Spectrum(value), 0.0), dr.select(active, density, 0.0)

    def eval(self, ctx, si, wo, active=True):
        return self.eval_pdf(ctx, si, wo, active)[0]

    def pdf(self, ctx, si, wo, active=True):
        return self.eval_pdf(ctx, si, wo, active)[1]

    def to_string(self):
        return "ThinLeaf[]"


mi.register_bsdf("thinleaf", ThinLeaf)


def rgb(*values):
    return {"type": "rgb", "value": list(values)}


def appearance(material):
    """What a shape with this material has, beside its triangles."""
    reflectance = material.reflectance
    return {
        "diffuse": lambda: {"bsdf": {"type": "twosided", "side": {"type": "diffuse", "reflectance": rgb(*[reflectance] * 3)}}},
        "leaf": lambda: {
            "bsdf": {
                "type": "thinleaf",
                "upper": reflectance,
                "lower": reflectance * LEAF_UNDERSIDE,
                "through": material.transmittance,
            }
        },
        "glass": lambda: {"bsdf": {"type": "dielectric", "int_ior": material.ior, "ext_ior": 1.0}},
        "emission": lambda: {
            "bsdf": {"type": "diffuse", "reflectance": rgb(0.0, 0.0, 0.0)},
            "emitter": {"type": "area", "radiance": rgb(*material.radiance)},
        },
        "medium": lambda: {"bsdf": {"type": "null"}, "interior": {"type": "ref", "id": "medium"}},
    }[material.kind]()


def sky_light(job):
    if job.scene.sky == "white":
        return {"sky": {"type": "constant", "radiance": rgb(1.0, 1.0, 1.0)}}
    if job.scene.sky == "picture":
        return {"sky": {"type": "envmap", "filename": job.sky_file}}
    return {}


def sensor(job):
    camera = job.scene.camera
    return {
        "type": "perspective",
        "fov_axis": "y",
        "fov": camera.fov,
        "near_clip": 0.01,
        "far_clip": 1e4,
        "to_world": mi.ScalarTransform4f().look_at(origin=camera.position, target=camera.target, up=[0, 1, 0]),
        "sampler": {"type": "multijitter"},
        "film": {
            "type": "hdrfilm",
            "width": job.width,
            "height": job.height,
            "pixel_format": "rgb",
            "component_format": "float32",
            "rfilter": {"type": "box"},
        },
    }


def describe(job):
    """The scene as the dictionary that Mitsuba loads. Lamps in a scene with a medium stand in it."""
    media = [material for _, material in job.scene.objects if material.kind == "medium"]
    scene = {
        "type": "scene",
        "integrator": {
            "type": "volpath" if media else "path",
            "max_depth": job.scene.depth + 1,
            "rr_depth": ROULETTE_DEPTH,
        },
        "sensor": sensor(job),
        **sky_light(job),
    }
    for medium in media:
        extinction = medium.scattering + medium.absorption
        scene["medium"] = {"type": "homogeneous", "albedo": medium.scattering / extinction, "sigma_t": extinction}
    for name, material in job.scene.objects:
        shape = {"type": "ply", "filename": os.path.join(job.folder, f"{name}.ply"), "face_normals": True}
        if media and material.kind == "emission":
            shape["exterior"] = {"type": "ref", "id": "medium"}
        scene[name] = shape | appearance(material)
    return scene


def load(job):
    dr.set_thread_count(job.threads)
    scene = mi.load_dict(describe(job))

    def draw(samples, seed):
        passes = -(-samples // SAMPLES_AT_ONCE)
        if samples % passes:
            raise ValueError(f"{samples} samples: at most {SAMPLES_AT_ONCE}, or a multiple of that")
        image, start = 0.0, time.perf_counter()
        for i in range(passes):
            image = image + np.array(mi.render(scene, spp=samples // passes, seed=seed * 1000 + i))
        return Drawing(image / passes, time.perf_counter() - start)

    return draw
