# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures by ray_trace(), with PyVista and Mitsuba: splats beside the true sphere, and what of a scene is traced."""

import pathlib
import tempfile
import unittest

import numpy as np
import pyvista as pv
from scatteredisopoints import contour, ray_trace

SIZE = (320, 240)
POSITIONS = np.random.default_rng(1).uniform(-1.2, 1.2, (300_000, 3))
SPLATS = contour(POSITIONS, np.linalg.norm(POSITIONS, axis=1), 1.0).splats().to_pyvista()
SPHERE = pv.Sphere(radius=1.0, theta_resolution=1600, phi_resolution=800)  # within 3e-6 of the true one
BALL = pv.Sphere(radius=1.0, theta_resolution=60, phi_resolution=60)
TAN = (0.9, 0.7, 0.3)


def psnr(one, other):
    return 10 * np.log10(255**2 / np.mean((one.astype(float) - other) ** 2))


def plotter_of(mesh=None, floor=True, **properties):
    plotter = pv.Plotter(off_screen=True, window_size=SIZE, lighting="none")
    if mesh is not None:
        plotter.add_mesh(mesh, **{"color": TAN, "smooth_shading": True, **properties})
    if floor:
        plotter.add_mesh(pv.Plane(center=(0, 0, -1), i_size=8, j_size=8), color=(0.5, 0.5, 0.6))
    plotter.add_light(pv.Light(position=(-3, -4, 6)))
    plotter.set_background((0.9, 0.95, 0.99), top=(0.2, 0.4, 0.8))
    plotter.camera_position = [(0, -5, 1.2), (0, 0, 0), (0, 0, 1)]
    return plotter


def middle_of(picture):
    """The mean color of what is in the middle."""
    return picture[115:125, 155:165].reshape(-1, 3).mean(axis=0)


class Pictures(unittest.TestCase):
    def test_splats_are_like_the_true_sphere(self):
        for name, bar, samples, properties in (
                ("matte", 45, 128, {}), ("mirror", 50, 32, {"pbr": True, "metallic": 1.0, "roughness": 0.0}),
                ("glass", 50, 32, {"pbr": True, "metallic": 0.0, "roughness": 0.0, "opacity": 0.0})):
            with self.subTest(name):
                picture, expected = (
                    ray_trace(plotter_of(mesh, **properties), samples=samples) for mesh in (SPLATS, SPHERE))
                self.assertGreater(psnr(picture, expected), bar)
                self.assertLess(psnr(picture, ray_trace(plotter_of(), samples=16)), 25, "the sphere is seen")

    def test_a_matte_scene_is_as_bright_as_in_the_window(self):
        """Without shadows, which VTK does not draw, in parallel and in perspective."""
        for is_parallel in (False, True):
            plotter = plotter_of(BALL, floor=False)
            if is_parallel:
                plotter.enable_parallel_projection()
            plotter.set_background("black")
            picture = ray_trace(plotter, samples=64, light_angle=0.01)
            with self.subTest(parallel=is_parallel):
                self.assertGreater(psnr(picture, plotter.screenshot(return_img=True)), 28)

    def test_surfaces_that_are_turned_over_look_the_same(self):
        turned = BALL.copy()
        turned.flip_faces(inplace=True)
        turned.point_data["Normals"] = -np.asarray(turned.point_data["Normals"])
        for properties in ({}, {"pbr": True, "metallic": 0.0, "roughness": 0.0, "opacity": 0.0}):
            expected, picture = (ray_trace(plotter_of(mesh, **properties), samples=32) for mesh in (BALL, turned))
            self.assertGreater(psnr(picture, expected), 35, properties)

    def test_colors_are_those_of_the_mapper(self):
        for name in ("point_data", "cell_data"):
            mesh = pv.Plane(i_size=8, j_size=8, direction=(0, -1, 0))
            values = getattr(mesh, name)
            values["a"] = np.linspace(0, 1, mesh.n_points if name == "point_data" else mesh.n_cells)
            plotter = plotter_of(mesh, floor=False, color=None, scalars="a", cmap="viridis", show_scalar_bar=False,
                                 smooth_shading=False)
            plotter.remove_all_lights()
            plotter.add_light(pv.Light(position=(0, -5, 0)))
            plotter.set_background("black")
            self.assertGreater(psnr(ray_trace(plotter, samples=64), plotter.screenshot(return_img=True)), 25, name)

    def test_only_what_is_drawn_as_a_surface_is_traced(self):
        nothing = ray_trace(plotter_of(floor=False))
        top, bottom = (nothing[row, 0] / 255 for row in (0, -1))
        np.testing.assert_allclose(top, (0.2, 0.4, 0.8), atol=0.01)
        np.testing.assert_allclose(bottom, (0.9, 0.95, 0.99), atol=0.01)
        hidden = plotter_of(BALL, floor=False)
        hidden.renderer.actors[next(iter(hidden.renderer.actors))].SetVisibility(False)
        with_nan = pv.Sphere()
        with_nan.points[:] = np.nan
        for name, plotter in (
                ("hidden", hidden), ("lines", plotter_of(BALL, floor=False, style="wireframe")),
                ("clear", plotter_of(BALL, floor=False, opacity=0.0)),
                ("not finite", plotter_of(with_nan, floor=False)), ("a line", plotter_of(pv.Line(), floor=False))):
            with self.subTest(name):
                np.testing.assert_array_equal(ray_trace(plotter), nothing)
        blocks = pv.MultiBlock([BALL, pv.Sphere(center=(0, 0, 5))])
        self.assertLess(psnr(ray_trace(plotter_of(blocks, floor=False)), nothing), 20, "blocks are traced")

    def test_any_unit_gives_the_same_picture(self):
        expected = ray_trace(plotter_of(BALL), samples=16)
        for scale in (1e-9, 1e9):
            plotter = plotter_of(BALL)
            for actor in plotter.renderer.actors.values():
                actor.scale = scale
            plotter.renderer.lights[0].position = tuple(scale * np.array((-3, -4, 6)))
            plotter.camera_position = [(0, -5 * scale, 1.2 * scale), (0, 0, 0), (0, 0, 1)]
            plotter.renderer.ResetCameraClippingRange()
            self.assertGreater(psnr(ray_trace(plotter, samples=16), expected), 35, scale)

    def test_light_passes_what_is_translucent(self):
        solid, half = (middle_of(ray_trace(plotter_of(BALL, opacity=opacity), samples=64)) for opacity in (1.0, 0.5))
        self.assertGreater(abs(solid - half).max(), 20)

    def test_lights_are_soft_and_of_any_kind(self):
        def shades(**options):
            picture = ray_trace(plotter_of(BALL), samples=64, **options)
            return np.count_nonzero((picture.max(axis=2) > 60) & (picture.max(axis=2) < 90))

        self.assertGreater(shades(light_angle=20.0), 1.3 * shades(light_angle=0.1), "half shadows")
        for positional, cone in ((True, 90.0), (True, 30.0)):
            plotter = plotter_of(BALL)
            light = plotter.renderer.lights[0]
            light.positional, light.cone_angle = positional, cone
            self.assertGreater(middle_of(ray_trace(plotter, samples=16)).max(), 50)
        plotter.remove_all_lights()
        plotter.renderer.SetAutomaticLightCreation(False)
        dark = middle_of(ray_trace(plotter, samples=16, ambient_light=0.05)).max()
        self.assertTrue(0 < dark < 20, dark)


class Calls(unittest.TestCase):
    def test_files_sizes_and_progress(self):
        shares = []
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "a.png"
            picture = ray_trace(plotter_of(BALL), path, samples=20, size=(80, 60), progress=shares.append)
            self.assertEqual((picture.shape, picture.dtype, shares), ((60, 80, 3), np.uint8, [0.5, 1.0]))
            np.testing.assert_array_equal(np.asarray(pv.read(path).active_scalars).reshape(60, 80, 3)[::-1], picture)
            with self.assertRaises(OSError):
                ray_trace(plotter_of(BALL), pathlib.Path(folder) / "none/a.png")
            with self.assertRaises(KeyError):
                ray_trace(plotter_of(BALL), path, progress={}.__getitem__)
            self.assertEqual([each.name for each in path.parent.iterdir()], ["a.png"], "the earlier picture stays")

    def test_scenes_of_every_kind(self):
        plotter = plotter_of(BALL)
        expected = ray_trace(plotter, samples=16)
        for scene in (plotter.renderer, plotter.render_window):
            np.testing.assert_array_equal(ray_trace(scene, samples=16, size=SIZE), expected)
        first = pv.Plotter(off_screen=True, window_size=SIZE)  # which has not been shown
        first.add_mesh(BALL)
        self.assertGreater(np.ptp(ray_trace(first)), 50)

    def test_wrong_arguments_are_named(self):
        plotter = plotter_of(BALL)
        for options, word in (
                ({"samples": 0}, "samples"), ({"size": (0, 10)}, "width"), ({"size": (10, 10**6)}, "height"),
                ({"light_angle": 0.0}, "light_angle"), ({"ambient_light": 2.0}, "ambient_light")):
            with self.subTest(word), self.assertRaisesRegex(ValueError, word):
                ray_trace(plotter, **options)
        with self.assertRaisesRegex(TypeError, "no plotter"):
            ray_trace(BALL)

    def test_the_variant_of_mitsuba_stays(self):
        import mitsuba

        mitsuba.set_variant("llvm_ad_rgb")
        ray_trace(plotter_of(BALL), size=(8, 8))
        self.assertEqual(mitsuba.variant(), "llvm_ad_rgb")


if __name__ == "__main__":
    unittest.main()
