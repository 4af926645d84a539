# SPDX-License-Identifier: GPL-3.0-or-later
"""Shapes the figures draw, against shapes with formulas and what the programs compute: contours, silhouettes, the gland's surface,
slices of a scan, the border of the image, the grey of a mammogram."""
import dataclasses
import types
import unittest
from pathlib import Path

import breast
import numpy as np
import small_run

try:
    import matplotlib  # noqa: F401
    import vtkmodules  # noqa: F401
    from breast.elements import element_volumes
    from breast.figures.body import add_image_border, gland_facets, two_plates
    from breast.figures.inputs import Inputs
    from breast.figures.colours import WHITE, Stroke
    from breast.figures.layout import Picture
    from breast.figures.mammogram import free_height, hung, parts_inside
    from breast.figures.muscle import back_words
    from breast.figures.outlines import joined
    from breast.figures.scene import Camera, Scene
    from breast.figures.silhouette import contours, gaussian, silhouette
    from breast.figures.slices import AXIAL, CORONAL, SAGITTAL, Slices
    from breast.figures.states import _hands
    from breast.views import image_frame
except ImportError as error:
    raise unittest.SkipTest(f"figures need python3-matplotlib and python3-vtk9 ({error})") from None


def length(lines):
    return sum(np.linalg.norm(np.diff(line, axis=0), axis=1).sum() for line in lines)


class Lines(unittest.TestCase):
    def test_contours_of_a_distance_are_circles(self):
        rows, columns = np.mgrid[0:101, 0:121]
        centre = np.array([31.3, 24.7])
        field = np.hypot(0.5 * columns - centre[0], 0.5 * rows - centre[1])
        found = contours(field, 20, 0.5, np.zeros(2))
        self.assertLess(max(np.abs(np.linalg.norm(line - centre, axis=1) - 20).max() for line in found), 0.01)
        self.assertAlmostEqual(length(found), 40 * np.pi, delta=0.1)
        self.assertEqual(contours(field, 1000, 0.5, np.zeros(2)), [])
        field[:, :60] = np.nan  # where the breast is far, nothing is drawn
        self.assertTrue(all((line[:, 0] >= 30).all() for line in contours(field, 20, 0.5, np.zeros(2))))

    def test_a_word_keeps_clear_of_rings(self):
        ring = (np.array([200.0, 130.0]), 9.0)
        self.assertEqual(free_height([114, 134, 154], 210, -60, []), 114)
        self.assertEqual(free_height([114, 134, 154], 210, -60, [ring]), 154)
        self.assertEqual(free_height([114, 134, 154], 120, -60, [ring]), 114, "beside it")
        self.assertEqual(free_height([134], 210, -60, [ring]), 134, "nowhere else to go")

    def test_smoothing_keeps_a_straight_border(self):
        field = np.zeros((40, 60))
        field[:, 30:] = 1
        for line in contours(gaussian(field, 2), 0.5, 1, np.zeros(2)):
            np.testing.assert_allclose(line[:, 0], 29.5, atol=1e-6)

    def test_a_ball_is_seen_as_a_circle(self):
        polar, around = np.meshgrid(np.linspace(0, np.pi, 49), np.linspace(0, 2 * np.pi, 49), indexing="ij")
        ball = 40 * np.stack([np.sin(polar) * np.cos(around), np.sin(polar) * np.sin(around), np.cos(polar)], -1).reshape(-1, 3)
        corner = (np.arange(48)[:, None] * 49 + np.arange(48)).ravel()
        seen = silhouette(ball[:, :2], corner[:, None] + [0, 1, 50, 49])
        self.assertEqual(len(seen), 1)
        np.testing.assert_allclose(np.linalg.norm(seen[0], axis=1), 40, atol=0.8)

    def test_segments_are_joined_in_any_order(self):
        line = np.array([[0, 0], [1, 0], [2, 1], [2, 3], [0, 4.0]])
        pieces = np.stack([line[:-1], line[1:]], 1)[[2, 0, 3, 1]]
        pieces[1] = pieces[1][::-1]
        found = joined(pieces)
        self.assertEqual(len(found), 1)
        self.assertIn(found[0].tolist(), (line.tolist(), line[::-1].tolist()))

    def test_curves_end_at_the_images_border(self):
        size = np.array([80, 150])
        whole, outside = parts_inside(np.array([[10, 10], [20, 90], [70, 140.0]]), size)
        self.assertEqual([len(part) for part in whole], [3])
        self.assertAlmostEqual(outside, 0)
        # In, out beyond u = 80, in again, and at last beyond v = 0.
        parts, outside = parts_inside(np.array([[60, 50], [100, 50], [100, 60], [60, 60], [60, -30.0]]), size)
        self.assertAlmostEqual(outside, 20 + 10 + 20 + 30)
        np.testing.assert_allclose([parts[0][-1], parts[1][0], parts[1][-1]], [[80, 50], [80, 60], [60, 0]])
        self.assertEqual(parts_inside(np.array([[-5, 3], [-5, 90.0]]), size), ([], 87))


class Places(unittest.TestCase):
    def bar(self, *lines):
        """The left end of the scale bar, pixels, of a panel 400 wide with lines in pixels."""
        panel = Picture(400, 300).panel(0, 0, 1, 1)
        panel.frame(np.array([200, 150]), 1)
        panel.lines([np.array(line, float) for line in lines], Stroke((1, 1, 1), 2))
        drawn = []
        panel.line = lambda places, stroke: drawn.append(places)
        panel.scale_bar(WHITE, either_side=True)
        return drawn[0][0][0]

    def test_a_scale_bar_keeps_clear_of_contours(self):
        right, left = self.bar(), self.bar([(300, 0), (330, 60)])
        self.assertTrue(right > 200 and left < 100)
        self.assertEqual(self.bar([(300, 100), (330, 60)]), right, "above it")
        self.assertEqual(self.bar([(0, 20), (400, 20)]), right, "crossed on both sides")

    def test_a_letter_of_the_compass_lies_on_no_arm(self):
        def letters(direction, up):
            panel, said = Picture(400, 300).panel(0, 0, 1, 1), []
            panel.camera = Camera(np.array(direction, float), np.array(up, float))
            panel.text = lambda at, words, *args, **kwargs: said.append(words)
            panel.compass()
            return "".join(sorted("".join(said)))
        self.assertEqual(letters([0.05, -0.2, -1], [0, -1, 0]), "AL", "S would stand on the arrow to A")
        self.assertEqual(letters([-0.75, 0.75, -0.35], [0, 0, 1]), "ALS")
        self.assertEqual(letters([0, 1, 0], [0, 0, 1]), "LS", "A points at the viewer")
        # Along the plates of an oblique view, of which two axes point upwards, one farther than the other.
        self.assertEqual(letters([0.5, 0.3, -0.4], [0.6, 0, 0.7]), "ALS")

    def test_balls_and_tubes_are_shown_whole(self):
        scene = Scene()
        scene.balls(np.array([[10.0, 20, 30]]), 4, (1, 0, 0))
        np.testing.assert_allclose([scene.shown().min(0), scene.shown().max(0)], [[6, 16, 26], [14, 24, 34]])
        scene.tube(np.array([[0.0, 0, 0], [0, 0, 50]]), 2, (1, 0, 0))
        np.testing.assert_allclose([scene.shown().min(0), scene.shown().max(0)], [[-2, -2, -2], [14, 24, 52]])


class States(unittest.TestCase):
    def test_a_hand_that_lets_go_is_said(self):
        """As it lets go the breast may slip back, which without a word looks like an error."""
        folder = small_run.scratch("hand")
        states = [types.SimpleNamespace(file=folder / f"state_00{k}.vtkhdf") for k in (1, 2, 3)]
        self.assertEqual(_hands(states), ["", "", ""], "a folder without a table, or gravity that turns")
        rows = [f"state_00{k}.vtkhdf\t{carries}\t{pulls}\n" for k, carries, pulls in ((1, 100, 20), (2, 0, 3.5), (3, 0, 0))]
        (folder / "states.tsv").write_text("file\thand_carries_percent\thand_pulls_N\n" + "".join(rows))
        self.assertEqual(_hands(states), [", held by a hand", ", held by a hand", ", the hand has let go"])


class OfARun(unittest.TestCase):
    def setUp(self):
        self.run_folder = breast.load(small_run.folder())

    def test_the_glands_surface_encloses_its_volume_and_follows_the_tissue(self):
        for state in (self.run_folder.mesh, breast.Run(small_run.quadratic()).mesh):
            surface = gland_facets(state, state.imaged)
            a, b, c = (surface.points[surface.quads[:, k]] for k in range(3))
            enclosed = abs(np.einsum("ij,ij->i", a, np.cross(b, c)).sum()) / 6
            order = 1 if state.hexahedra.shape[1] == 8 else 2
            volume = element_volumes(order, state.imaged[state.hexahedra]) @ state.cell_arrays["fibroglandular_fraction"]
            self.assertLess(abs(enclosed - volume), 0.15 * volume)  # coarse elements, some of it cut by the skin
            # The element map carries the surface: an affine deformation of the nodes is one of the surface.
            gradient = np.array([[1.3, 0.2, 0], [-0.1, 0.6, 0.1], [0, 0.3, 1.1]])
            moved = gland_facets(state, state.imaged @ gradient.T + [3, -40, 7])
            self.assertEqual(len(moved.points), len(surface.points))
            np.testing.assert_allclose(surface.points @ gradient.T + [3, -40, 7], moved.points, atol=1e-3)
            np.testing.assert_allclose(np.linalg.norm(surface.normals, axis=1), 1)
        none = dataclasses.replace(state, cell_arrays={"fibroglandular_fraction": np.zeros(len(state.hexahedra))})
        self.assertEqual(len(gland_facets(none, none.imaged).quads), 0)

    def test_the_border_is_that_of_the_image(self):
        for view in ("cc", "mlo"):
            image, frame = self.run_folder.mammograms[view], image_frame(self.run_folder.state(view))
            np.testing.assert_allclose(frame.pose.origin, image.origin, atol=1e-9)
            np.testing.assert_allclose([frame.pose.e_u, frame.pose.e_v, frame.pose.n], [image.e_u, image.e_v, image.n], atol=1e-12)
            nv, nu = image.images["path"].shape
            self.assertLess(max(abs(frame.width - nu * image.pixel_mm), abs(frame.height - nv * image.pixel_mm)), image.pixel_mm + 1e-9)

    def test_the_border_lies_on_the_detector(self):
        """Also where tissue behind the plate hangs below it."""
        state = self.run_folder.state("cc")
        detector, n = two_plates(state)[1].origin, image_frame(state).pose.n
        hanging = dataclasses.replace(state, points=state.points.copy())
        hanging.points[state.node_sets["pectoral"]] += 30 * n
        self.assertGreater((image_frame(hanging).pose.origin - detector) @ n, 5, "the image's own origin is below it")
        for shape in (state, hanging):
            scene = Scene()
            add_image_border(scene, shape)
            heights = (scene.shown() - detector) @ n
            self.assertLess(np.abs(heights).max(), 1.5, "as thick as its lines")

    def test_mammograms_are_as_grey_as_the_programs_hang_them(self):
        from matplotlib.image import imread
        for view in ("cc", "mlo"):
            programs = imread(small_run.folder() / f"{view}.png")
            np.testing.assert_array_equal(np.rint(65535 * hung(self.run_folder.mammograms[view])), np.rint(65535 * programs))

    def test_a_mammogram_without_greys_is_refused(self):
        image = self.run_folder.mammograms["cc"]
        old = dataclasses.replace(image, images={name: values for name, values in image.images.items() if name != "grey"})
        with self.assertRaisesRegex(breast.errors.BreastError, "cc.vti: holds no array grey; .*run project-mammogram again"):
            hung(old)

    def test_the_wall_is_where_the_body_lies_on_it(self):
        mesh = self.run_folder.mesh
        nodes = mesh.imaged[mesh.node_sets["pectoral"]]
        for place in nodes[:: max(1, len(nodes) // 10)]:
            line = mesh.thorax.at_height(place[2], 4000)
            self.assertLess(np.linalg.norm(line - place, axis=1).min(), 0.2)
        self.assertEqual(mesh.thorax.at_height(1e4).shape, (0, 3))

    def test_muscle_is_called_assumed(self):
        self.assertEqual(back_words(self.run_folder.mesh), "chest wall")
        folder = small_run.scratch("muscle")
        for options, words in (("measured", "back of the muscle (8 mm, assumed where the scan does not show it)"),
                               ("6", "back of the muscle (6 mm, assumed)")):
            small_run.tool(f"hexmesh {small_run.folder()}/geometry.vtkhdf {small_run.folder()}/labels.vtkhdf {options}.vtkhdf "
                           f"--elements 6 --muscle {options}", folder)
            self.assertEqual(back_words(breast.load(folder / f"{options}.vtkhdf")), words)


class OfAScan(unittest.TestCase):
    """A ball of fat of 40 mm with a ball of gland of 20 mm in it, on muscle behind y = 30."""

    def setUp(self):
        grid = breast.Grid((101, 101, 51), np.array([1.0, 1, 2]), np.array([-50.0, -50, -50]), np.eye(3))
        k, j, i = np.meshgrid(range(51), range(101), range(101), indexing="ij")
        x = grid.to_patient(np.stack([i, j, k], -1))
        radius = np.linalg.norm(x, axis=-1)
        tissue = np.where(x[..., 1] > 30, 4, np.where(radius < 20, 2, np.where(radius < 40, 1, 0))).astype(np.uint8)
        self.labels = breast.Labels(Path("labels"), grid, tissue, (radius < 20).astype(np.float32), np.ones(tissue.shape), {}, "left",
                                    0.0, None, ())
        voxels = np.where(np.abs(x - [20, -24, 30]).max(-1) < 3, 1000, 100).astype(np.float32)
        self.scan = breast.Volume(Path("scan"), grid, voxels)

    def drawn(self, plane):
        """The panel on which the plane is drawn, and lines in LPS mm by colour."""
        slices, panel = Slices(Inputs(scan=self.scan, labels=self.labels)), Picture(600, 600).panel(0, 0, 1, 1)
        slices.white = 1000  # all of the ball is darker than the mark
        slices.draw(panel, plane, 0.25, "(a)")
        middle = 0.5 * (slices.low + slices.high)
        middle[plane.axis] = slices.through[plane.axis]
        found = {}
        for collection in panel.axes.collections:
            flat = [np.asarray(path.vertices) - panel.centre for path in collection.get_paths()]
            places = [middle + line[:, :1] * plane.right + line[:, 1:] * plane.up for line in flat]
            found[tuple(np.round(collection.get_color()[0][:3], 2))] = np.concatenate(places)
        return found, panel, middle

    def test_contours_are_where_the_tissues_end(self):
        from breast.figures.colours import GLAND_LINE, SKIN_LINE, WALL_LINE
        for plane in (AXIAL, SAGITTAL, CORONAL):
            found = self.drawn(plane)[0]
            np.testing.assert_allclose(np.linalg.norm(found[GLAND_LINE.colour], axis=1), 20, atol=1.2)
            self.assertEqual(WALL_LINE.colour in found, plane is not CORONAL)
            if plane is not CORONAL:
                np.testing.assert_allclose(found[WALL_LINE.colour][:, 1], 30.5, atol=1.2)
            skin = found[SKIN_LINE.colour]
            skin = skin[skin[:, 1] < 26]  # beside the muscle, which is body too, the border of the body leaves the ball
            np.testing.assert_allclose(np.linalg.norm(skin, axis=1), 40, atol=1.5)

    def test_points_are_where_the_letters_say(self):
        mark = np.array([20, -24, 30.0])  # left, anterior, superior
        self.labels.landmarks["tumour"] = mark
        for plane in (AXIAL, SAGITTAL, CORONAL):
            _, panel, middle = self.drawn(plane)
            image = panel.axes.images[0]
            grey, (left, right, low, high) = np.asarray(image.get_array())[::-1], image.get_extent()
            row, column = (n.mean() for n in np.nonzero(grey > 0.9 * grey.max()))
            at = [left + (column + 0.5) * (right - left) / grey.shape[1], low + (row + 0.5) * (high - low) / grey.shape[0]]
            at -= panel.centre
            np.testing.assert_allclose(middle + at[0] * plane.right + at[1] * plane.up, mark, atol=0.6)
        self.assertGreater(AXIAL.right @ [1, 0, 0], 0)
        self.assertGreater(AXIAL.up @ [0, -1, 0], 0)
        self.assertGreater(SAGITTAL.right @ [0, 1, 0], 0)
        self.assertGreater(CORONAL.up @ [0, 0, 1], 0)

    def test_a_nipple_is_marked_where_the_slice_goes_through_it(self):
        """5 mm beside its middle a slice shows skin some 10 mm behind its tip: the mark would stand in air."""
        slices = Slices(Inputs(scan=self.scan, labels=self.labels))
        for plane in (AXIAL, SAGITTAL, CORONAL):
            for beside, marked in ((2.0, True), (5.0, False)):
                nipple = slices.through + beside * np.eye(3)[plane.axis]
                slices.labels = dataclasses.replace(self.labels, landmarks={"nipple": nipple})
                self.assertEqual(slices.nipple(plane) is not None, marked)

    def test_what_is_no_breast_is_refused(self):
        with self.assertRaisesRegex(breast.BreastError, "there is no breast to show"):
            Slices(Inputs(scan=self.scan, labels=dataclasses.replace(self.labels, tissue=np.zeros_like(self.labels.tissue))))
        dark = dataclasses.replace(self.scan, voxels=np.zeros_like(self.scan.voxels))
        with self.assertRaisesRegex(breast.BreastError, "is it another scan"):
            Slices(Inputs(scan=dark, labels=self.labels)).white


if __name__ == "__main__":
    unittest.main()
