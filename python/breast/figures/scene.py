# SPDX-License-Identifier: GPL-3.0-or-later
"""Surfaces in space, drawn off-screen by VTK as a parallel projection."""
from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from functools import lru_cache
from typing import Any

import numpy as np
from vtkmodules import vtkRenderingOpenGL2  # noqa: F401 - the implementation
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkLookupTable, vtkPoints, vtkUnsignedCharArray
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkFiltersCore import vtkGlyph3D, vtkPolyDataNormals, vtkTubeFilter
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkRenderingCore import vtkActor, vtkLightKit, vtkPolyDataMapper, vtkRenderer, vtkRenderWindow

from ..errors import Failed
from .colours import HEAT, Colour
from .display import PrivateDisplay

SUPERSAMPLING = 2
"""Pictures are drawn larger by this factor and averaged, for smooth edges also of translucent surfaces."""


@dataclass
class Facets:
    """A surface of quadrilaterals; a triangle repeats its last corner.

    Attributes:
        points: (P, 3) mm.
        quads: (Q, 4) rows of points.
        normals: (P, 3) for shading, or None: from the facets.
    """

    points: np.ndarray
    quads: np.ndarray
    normals: np.ndarray | None = None


@dataclass(frozen=True)
class Look:
    """How a surface is drawn: smooth shades across facets that meet below 50°."""

    colour: Colour
    opacity: float = 1.0
    smooth: bool = True
    edges: bool = False
    shine: float = 0.15


@dataclass(frozen=True)
class Camera:
    """Viewing direction and upward direction in the patient's frame, of any length; they need not be perpendicular."""

    direction: np.ndarray
    up: np.ndarray

    def axes(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Unit vectors to the right, to the top, and forwards."""
        forward = self.direction / np.linalg.norm(self.direction)
        right = np.cross(forward, self.up)
        right /= np.linalg.norm(right)
        return right, np.cross(right, forward), forward

    def flat(self, points: np.ndarray) -> np.ndarray:
        """Positions (n, 2) in the picture's plane, mm to the right and upwards, of points (n, 3)."""
        right, top, _ = self.axes()
        return points @ np.stack([right, top], -1)


@dataclass
class Scene:
    """What one panel shows. Things are drawn by depth; those added `through` stand before all others, whatever their depth."""

    _actors: list[tuple[Any, bool]] = field(default_factory=list)
    _shown: list[np.ndarray] = field(default_factory=list)

    def shown(self) -> np.ndarray:
        """All points (n, 3) that the picture must show, mm."""
        return np.concatenate(self._shown)

    def surface(self, facets: Facets, look: Look, through: bool = False) -> None:
        if not len(facets.quads):
            return
        data, mapper = _poly_data(facets), vtkPolyDataMapper()
        if facets.normals is not None:
            data.GetPointData().SetNormals(numpy_to_vtk(np.ascontiguousarray(facets.normals), deep=True))
            mapper.SetInputData(data)
        elif look.smooth:
            normals = vtkPolyDataNormals()
            normals.SetFeatureAngle(50)
            normals.ConsistencyOff()
            normals.SetInputData(data)
            mapper.SetInputConnection(normals.GetOutputPort())
        else:
            mapper.SetInputData(data)
        actor = self._add(mapper, look.colour, facets.points[np.unique(facets.quads)], through)
        shading = actor.GetProperty()
        shading.SetOpacity(look.opacity)
        shading.SetAmbient(0.12)
        shading.SetDiffuse(0.85)
        shading.SetSpecular(look.shine)
        shading.SetSpecularPower(25)
        if not look.smooth:
            shading.SetInterpolationToFlat()
        if look.edges:
            _draw_edges(shading, (0.15, 0.15, 0.15), 0.7)

    def values(self, facets: Facets, at_points: np.ndarray, high: float) -> None:
        """Facets in the colours of a value at each point (P), from 0 to `high`; the values are interpolated, not the colours."""
        data = _poly_data(facets)
        data.GetPointData().SetScalars(numpy_to_vtk(np.ascontiguousarray(at_points), deep=True))
        shades = HEAT(np.linspace(0, 1, 256))
        table = vtkLookupTable()
        table.SetNumberOfTableValues(len(shades))
        for k, shade in enumerate(shades):
            table.SetTableValue(k, *shade)
        mapper = vtkPolyDataMapper()
        mapper.SetInputData(data)
        mapper.InterpolateScalarsBeforeMappingOn()
        mapper.SetLookupTable(table)
        mapper.SetScalarRange(0, high)
        shading = self._add(mapper, None, facets.points, False).GetProperty()
        shading.SetAmbient(0.75)  # compared with a colour bar: hardly any shading
        shading.SetDiffuse(0.25)
        _draw_edges(shading, (0.6, 0.55, 0.5), 0.4)

    def balls(self, points: np.ndarray, radius: float, colour: Colour, through: bool = False) -> None:
        """Spheres of one radius in mm around points (n, 3)."""
        data = vtkPolyData()
        data.SetPoints(vtk_points(points))
        many = len(points) > 100
        ball = vtkSphereSource()
        ball.SetRadius(radius)
        ball.SetThetaResolution(8 if many else 32)
        ball.SetPhiResolution(6 if many else 24)
        glyphs = vtkGlyph3D()
        glyphs.SetInputData(data)
        glyphs.SetSourceConnection(ball.GetOutputPort())
        glyphs.ScalingOff()
        mapper = vtkPolyDataMapper()
        mapper.SetInputConnection(glyphs.GetOutputPort())
        shading = self._add(mapper, colour, _widened(points, radius), through).GetProperty()
        shading.SetAmbient(0.25)
        shading.SetSpecular(0.3)

    def tube(self, points: np.ndarray, radius: float, colour: Colour, through: bool = False) -> None:
        """A line through points (n, 3) as thick as `radius` in mm to every side."""
        if len(points) < 2:
            return
        cells = vtkCellArray()
        cells.InsertNextCell(len(points), list(range(len(points))))
        data = vtkPolyData()
        data.SetPoints(vtk_points(points))
        data.SetLines(cells)
        tube = vtkTubeFilter()
        tube.SetRadius(radius)
        tube.SetNumberOfSides(14)
        tube.CappingOn()
        tube.SetInputData(data)
        mapper = vtkPolyDataMapper()
        mapper.SetInputConnection(tube.GetOutputPort())
        self._add(mapper, colour, _widened(points, radius), through).GetProperty().SetAmbient(0.35)

    def _add(self, mapper: Any, colour: Colour | None, points: np.ndarray, through: bool) -> Any:
        actor = vtkActor()
        actor.SetMapper(mapper)
        if colour is not None:
            mapper.ScalarVisibilityOff()
            actor.GetProperty().SetColor(colour)
        self._actors.append((actor, through))
        self._shown.append(points)
        return actor

    def image(self, camera: Camera, centre: np.ndarray, mm_per_pixel: float, width: int, height: int) -> np.ndarray:
        """RGB (height, width, 3), 0 to 255, on white; `centre` (2) is the middle of the view in the camera's plane, mm."""
        window = _window()
        window.SetSize(width * SUPERSAMPLING, height * SUPERSAMPLING)
        right, top, forward = camera.axes()
        focus = centre[0] * right + centre[1] * top + self.shown().mean(0) @ forward * forward
        renderers = [vtkRenderer(), vtkRenderer()]
        view = renderers[0].GetActiveCamera()
        for layer, renderer in enumerate(renderers):
            for actor, through in self._actors:
                if through == bool(layer):
                    renderer.AddActor(actor)
            lights = vtkLightKit()
            lights.SetKeyLightIntensity(0.85)
            lights.SetKeyLightAngle(35, -25)
            lights.AddLightsToRenderer(renderer)
            renderer.SetLayer(layer)
            renderer.SetActiveCamera(view)
            window.AddRenderer(renderer)
        renderers[0].SetBackground(1, 1, 1)
        renderers[0].SetUseDepthPeeling(any(a.GetProperty().GetOpacity() < 1 for a, _ in self._actors))
        renderers[0].SetMaximumNumberOfPeels(12)
        renderers[0].SetOcclusionRatio(0)
        view.ParallelProjectionOn()
        view.SetFocalPoint(*focus)
        view.SetPosition(*(focus - 1000 * forward))
        view.SetViewUp(*top)
        view.SetParallelScale(height * mm_per_pixel / 2)
        view.SetClippingRange(1, 3000)
        window.Render()
        pixels = vtkUnsignedCharArray()
        window.GetPixelData(0, 0, width * SUPERSAMPLING - 1, height * SUPERSAMPLING - 1, 0, pixels, 0)
        for renderer in renderers:
            window.RemoveRenderer(renderer)
        if pixels.GetNumberOfValues() != 3 * width * height * SUPERSAMPLING**2:
            raise Failed("the picture could not be drawn (OpenGL returned no pixels)")
        fine = vtk_to_numpy(pixels).reshape(height, SUPERSAMPLING, width, SUPERSAMPLING, 3)[::-1]
        return (fine.astype(np.uint16).sum((1, 3)) // SUPERSAMPLING**2).astype(np.uint8)


@lru_cache(maxsize=None)
def _window() -> Any:
    """One window for all pictures of the process: to open one takes as long as to draw in it."""
    window = vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(0)
    window.SetAlphaBitPlanes(1)
    window.SetNumberOfLayers(2)
    return window


@contextmanager
def display() -> Iterator[None]:
    """A private display for what is drawn in the block; its window is closed before the display ends."""
    with PrivateDisplay():
        try:
            yield
        finally:
            if _window.cache_info().currsize:
                _window().Finalize()
                _window.cache_clear()


def _draw_edges(shading: Any, colour: Colour, pixels: float) -> None:
    shading.EdgeVisibilityOn()
    shading.SetEdgeColor(colour)
    shading.SetLineWidth(pixels * SUPERSAMPLING)


def _widened(points: np.ndarray, radius: float) -> np.ndarray:
    """Points (n, 3) and those at a distance from them along the axes: what a ball or a tube reaches."""
    away = radius * np.concatenate([np.zeros((1, 3)), np.eye(3), -np.eye(3)])
    return (points + away[:, None]).reshape(-1, 3)


def vtk_points(points: np.ndarray) -> Any:
    made = vtkPoints()
    made.SetData(numpy_to_vtk(np.ascontiguousarray(points, np.float64), deep=True))
    return made


def _poly_data(facets: Facets) -> Any:
    triangle = facets.quads[:, 2] == facets.quads[:, 3]
    corners = np.where(triangle, 3, 4)
    cells = vtkCellArray()
    cells.SetData(numpy_to_vtkIdTypeArray(np.concatenate([[0], np.cumsum(corners)]).astype(np.int64), deep=True),
                  numpy_to_vtkIdTypeArray(facets.quads[np.arange(4) < corners[:, None]].astype(np.int64), deep=True))
    data = vtkPolyData()
    data.SetPoints(vtk_points(facets.points))
    data.SetPolys(cells)
    return data
