"""The arithmetic and the files of tests/bench/renderers, without the renderers that it compares."""

import sys

import numpy as np
import pytest

sys.path.insert(0, "tests/bench")

from renderers import geometry, llvm, measures, pictures, report, results, scenes, sky  # noqa: E402


def noisy(seed, samples, value=2.0, size=(60, 80)):
    """A flat image with noise of standard deviation 0.5 / sqrt(samples)."""
    return value + np.random.default_rng(seed).normal(0.0, 0.5 / np.sqrt(samples), (*size, 3))


def drawings(speed, error, mean=2.0):
    """Of a renderer with a fixed cost of 3 s a picture."""
    made = results.Drawings()
    for seed in range(4):
        for count in (16, 64, 128):
            made.images.setdefault(count, []).append(noisy(1000 * count + seed, count / error**2, mean))
            made.seconds.setdefault(count, []).append(3.0 + count / speed + 0.1 * seed)
    return made


def figures_of(**made):
    return results.all_figures(made, [16, 64], 128)


def test_trimming_leaves_out_the_largest_thousandth():
    values = np.ones(2000)
    values[[5, 7]] = 1e9
    assert measures.trimmed_mean(values) == 1.0
    values[9] = 1e9
    assert measures.trimmed_mean(values) > 1e5
    assert measures.trimmed_mean([4.0]) == 4.0


def test_relative_mse_is_the_variance_over_the_squared_radiance():
    reference = measures.reference_of([noisy(seed, 128) for seed in (1, 2)])
    expected = 0.25 / 16 / (4.0 * 1.01)
    assert measures.relative_mse([noisy(3, 16), noisy(4, 16)], reference) == pytest.approx(expected, rel=0.03)


def test_noise_of_the_reference_is_subtracted():
    reference = measures.reference_of([noisy(seed, 16) for seed in (1, 2)])
    expected = 0.25 / 16 / (4.0 * 1.01)
    assert reference.noise == pytest.approx(expected / 2, rel=0.05)
    whole = measures.trimmed_mean(measures.relative_squares((noisy(3, 16) - reference.image) ** 2, reference.image))
    assert whole == pytest.approx(1.5 * expected, rel=0.05)
    assert measures.relative_mse([noisy(3, 16)], reference) == pytest.approx(expected, rel=0.05)


def test_mean_has_the_error_of_its_pixels():
    reference = measures.reference_of([noisy(seed, 16) for seed in (1, 2, 3)])
    mean, error = measures.mean_and_error(reference)
    assert mean == pytest.approx(2.0, abs=4.0 * error)
    assert error == pytest.approx(0.5 / np.sqrt(16 * 3 * 4800), rel=0.05)
    half = np.arange(4800).reshape(60, 80) < 2400
    assert measures.mean_and_error(reference, half)[1] == pytest.approx(np.sqrt(2.0) * error, rel=0.05)
    with pytest.raises(measures.Unmeasurable, match="two independent"):
        measures.reference_of([noisy(1, 16)])


def test_dim_pixels_are_without_the_lamps():
    image = np.full((10, 10, 3), 0.2)
    image[:6] = 0.0
    image[9, 9], image[9, 8] = 2.5, 1.9
    dim = measures.dim_pixels([image, image])
    assert not dim[9, 9] and dim.sum() == 99
    assert measures.dim_pixels([np.zeros((2, 2, 3))]).all()


def test_time_of_a_sample_is_without_what_is_done_once():
    assert measures.seconds_per_sample({16: [2.6, 2.9], 64: [9.0], 128: [9.0, 8.2]}) == pytest.approx(0.05)
    with pytest.raises(measures.Unmeasurable, match="no longer"):
        measures.seconds_per_sample({16: [1.0], 128: [1.0]})


def test_efficiency_doubles_with_half_the_error_or_half_the_time():
    assert measures.efficiency(0.01, 2.0) == pytest.approx(50.0)
    assert measures.efficiency(0.005, 2.0) == measures.efficiency(0.01, 1.0) == pytest.approx(100.0)
    with pytest.raises(measures.Unmeasurable, match="more samples"):
        measures.efficiency(-1e-9, 2.0)
    assert measures.geometric_mean([0.5, 8.0]) == pytest.approx(2.0)


def test_table_holds_every_renderer_against_cycles():
    figures = figures_of(ramify=drawings(40.0, 0.5), cycles=drawings(10.0, 1.0), mitsuba3=drawings(20.0, 1.0))
    assert results.disagreeing(figures) == []
    assert results.error_ratio(figures, "ramify") == pytest.approx(0.25, rel=0.05)
    assert results.efficiency_ratio(figures, "ramify") == pytest.approx(16.0, rel=0.05)
    assert results.efficiency_ratio(figures, "ramify", "mitsuba3") == pytest.approx(8.0, rel=0.05)
    assert results.efficiency_ratio(figures, "cycles") == pytest.approx(1.0)
    rows = report.table({"s1": figures, "s2": figures}).splitlines()
    assert len(rows) == 5 and len({row.count("|") for row in rows}) == 1
    assert report.as_json({"s1": figures})["efficiency_geometric_mean"]["ramify/cycles"] == pytest.approx(16.0, rel=0.05)


def test_other_means_are_reported():
    cycles, mitsuba = drawings(10.0, 0.1), drawings(20.0, 0.1, 2.006)
    figures = figures_of(ramify=drawings(40.0, 0.1, 2.02), cycles=cycles, mitsuba3=mitsuba)
    assert results.disagreeing(figures) == ["ramify"]
    line = report.proof_line("s4", figures)
    assert "ramify +1.0" in line and "Mitsuba +0.3" in line and "DIFFERENT" in line


def test_a_difference_beside_lamps_is_reported():
    def lit(dim):
        made = drawings(10.0, 0.1, dim)
        for image in (image for images in made.images.values() for image in images):
            image[:20] += 200.0
        return made

    figures = figures_of(ramify=lit(2.04), cycles=lit(2.0), mitsuba3=lit(2.0))
    assert abs(results.mean_difference(figures, "ramify", "all")[0]) < results.LIMIT
    assert results.disagreeing(figures) == ["ramify"]


def test_a_difference_within_noise_is_no_difference():
    rough = figures_of(ramify=drawings(40.0, 60.0, 2.02), cycles=drawings(10.0, 60.0), mitsuba3=drawings(20.0, 0.1))
    assert abs(results.mean_difference(rough, "ramify", "all")[0]) > results.LIMIT
    assert results.disagreeing(rough) == [] and "ramify" in results.uncertain(rough)
    assert "within noise" in report.proof_line("s1", rough)


def test_no_number_is_no_agreement():
    nan = (float("nan"), 0.0)
    figures = figures_of(ramify=drawings(40.0, 0.1), cycles=drawings(10.0, 0.1), mitsuba3=drawings(20.0, 0.1))
    figures["ramify"].means["dim"] = nan
    assert results.disagreeing(figures) == ["ramify"]


def test_meshes_survive_the_file(tmp_path):
    vertices, triangles = geometry.box(np.zeros(3))
    geometry.write_ply(tmp_path / "box.ply", vertices, triangles)
    records, faces = geometry.read_ply(tmp_path / "box.ply")
    assert (geometry.positions_of(records) == vertices).all() and (faces == triangles).all()


def test_runs_of_quads_and_triangles_are_read():
    def face(*corners):
        return bytes([len(corners)]) + np.array(corners, "<i4").tobytes()

    lists = face(0, 1, 2) + face(2, 3, 4, 5) + face(4, 5, 6, 7) + face(7, 8, 9)
    faces = geometry.read_faces(lists, 4)
    assert sorted(map(tuple, faces)) == [(0, 1, 2), (2, 3, 4), (2, 4, 5), (4, 5, 6), (4, 6, 7), (7, 8, 9)]


def test_bodies_are_closed_and_outward():
    for vertices, triangles in (geometry.box(np.ones(3)), geometry.octahedra(np.ones((1, 3)), 0.5)):
        corner = vertices[triangles]
        normal = np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0])
        assert (np.einsum("ij,ij->i", normal, corner.mean(axis=1) - 1.0) > 0.0).all()
        edges = {(a, b) for t in triangles for a, b in zip(t, np.roll(t, -1))}
        assert all((b, a) in edges for a, b in edges)


def test_compact_drops_what_is_not_used():
    vertices = np.array([[9, 9, 9], [0, 0, 0], [1, 0, 0], [0, 1, 0]], float)
    kept, triangles = geometry.compact(vertices, np.array([[1, 2, 3], [1, 2, 2]]))
    assert kept.tolist() == [[0, 0, 0], [1, 0, 0], [0, 1, 0]] and triangles.tolist() == [[0, 1, 2]]


def test_sky_keeps_its_radiance_in_rgbe():
    image = np.array([[[130.0, 110.0, 80.0], [0.2, 0.4, 0.9], [0.0, 0.0, 0.0]]])
    rgbe = sky.to_rgbe(image).astype(float)
    decoded = (rgbe[..., :3] + 0.5) * 2.0 ** (rgbe[..., 3:] - 136) * (rgbe[..., 3:] > 0)
    assert decoded == pytest.approx(image, rel=0.01, abs=0.004)
    assert sky.panorama().max() == pytest.approx(130.0, rel=0.02)


def test_job_reaches_a_worker_unchanged():
    for scene in scenes.SCENES.values():
        job = scenes.Job(scene, "folder", "sky.hdr", 320, 180, 2)
        again = scenes.Job.from_json(job.to_json())
        assert again.to_json() == job.to_json()
        assert [material.kind for _, material in again.scene.objects] == [material.kind for _, material in scene.objects]


def test_llvm_is_found_by_its_version():
    old = "\tlibLLVM-15.so.1 (libc6,x86-64) => /lib/libLLVM-15.so.1\n"
    assert llvm.find_in(old + "\tlibLLVM.so.19.1 (libc6,x86-64) => /lib/libLLVM.so.19.1\n") == "/lib/libLLVM.so.19.1"
    assert llvm.find_in(old + "\tlibLLVM-19.so.1 (libc6,x86-64) => /lib/libLLVM-19.so.1\n") == "/lib/libLLVM-19.so.1"
    assert llvm.find_in(old) is None


def test_pictures_take_equal_time():
    assert pictures.equal_time_samples({"ramify": 0.5, "cycles": 1.0, "mitsuba": 0.1}, "ramify") == {
        "ramify": pictures.BASE_SAMPLES,
        "cycles": pictures.BASE_SAMPLES // 2,
        "mitsuba": 5 * pictures.BASE_SAMPLES,
    }
    assert pictures.equal_time_samples({"ramify": 1e-3, "cycles": 9.0}, "ramify")["cycles"] == 1


def test_pictures_of_a_row_share_one_exposure():
    reference = np.full((4, 6, 3), 2.0)
    line = pictures.row([0.5 * reference, 0.0 * reference], reference)
    assert line.shape == (4, 3 * 6 + 2 * pictures.GAP, 3)
    assert (line[:, -6:] == 255).all() and (line[:, :6] == 188).all()  # sRGB of 1 and 0.5
    assert (line[:, 6 + pictures.GAP : 12 + pictures.GAP] == 0).all()
    assert pictures.sheet([line, line]).shape == (8 + pictures.GAP, line.shape[1], 3)
