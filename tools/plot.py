#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of a run, made without a display: plot.py RUN writes PNG files into RUN/plots.

  probe-*.png, forces-*.png   each table's columns over time, one panel per unit
  steps.png                   iterations, divergence, CFL and the like over time
  vorticity.png               mid-plane vorticity at the last instant, with the sheets in it
  vorticity-instants.png      the same at instants equally spaced over the run
  shapes.png                  the sheets' mid-sections over time, one colour per instant

What a run has not written (a structure alone has no flow, a flow alone no sheets) is left out.
"""
import argparse
import csv
import re
import sys
import xml.etree.ElementTree as xml
from dataclasses import dataclass
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import LineCollection
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkObject
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkFiltersCore import vtkCellDataToPointData, vtkProbeFilter
from vtkmodules.vtkIOXML import (vtkXMLPolyDataReader, vtkXMLPRectilinearGridReader, vtkXMLPStructuredGridReader,
                                 vtkXMLRectilinearGridReader, vtkXMLStructuredGridReader)

AXES = "xyz"
COLOURS = ["#1f5fa8", "#d1495b", "#2a9d6f", "#e09f3e", "#7b4fa3", "#4d4d4d", "#38a3c9", "#a0522d"]
LOG_SCALE = re.compile("div|residual|imbalance")
UNPLOTTED = {"step", "t", "dt"}

plt.rcParams.update({
    "figure.dpi": 110, "savefig.dpi": 150, "font.size": 10, "axes.spines.top": False, "axes.spines.right": False,
    "axes.grid": True, "grid.color": "#e4e4e4", "grid.linewidth": 0.8, "axes.axisbelow": True, "lines.linewidth": 1.5,
    "axes.prop_cycle": plt.cycler(linestyle=["-", "--"]) * plt.cycler(color=COLOURS), "legend.frameon": False, "savefig.bbox": "tight",
})


# ---- tables ---------------------------------------------------------------------------------------------------------

@dataclass
class Column:
    name: str
    unit: str
    values: np.ndarray

    @property
    def label(self):
        return f"{self.name.replace('_', ' ')} [{self.unit}]" if self.unit else self.name.replace("_", " ")


def read_table(path):
    """The columns of a CSV file by name; a last line that was cut off is passed over."""
    with open(path, newline="") as file:
        rows = list(csv.reader(file))
    if not rows:
        return {}
    heads = [re.fullmatch(r"(.*?)(?: \[(.*)\])?", head).groups() for head in rows[0]]
    numbers = np.array([[float(cell) if cell else np.nan for cell in row] for row in rows[1:] if len(row) == len(heads)])
    if not len(numbers):
        return {}
    return {name: Column(name, unit or "", numbers[:, i]) for i, (name, unit) in enumerate(heads)}


def by_unit(columns):
    """Groups of columns that share an axis: one unit, and the same scale, linear or logarithmic."""
    groups = {}
    for column in columns:
        kind = "iterations" if "iterations" in column.name else column.unit or column.name
        groups.setdefault((kind, bool(LOG_SCALE.search(column.name))), []).append(column)
    return groups


def plot_group(axis, t, kind, logarithmic, columns):
    for column in columns:
        values = np.abs(column.values) if logarithmic else column.values
        style = {"drawstyle": "steps-post"} if kind == "iterations" else {}
        axis.plot(t.values, values, label=column.name.replace("_", " "), **style)
    if logarithmic and any(np.any(c.values != 0) for c in columns):
        axis.set_yscale("log")
    axis.set_ylabel(columns[0].label if len(columns) == 1 else kind)
    if len(columns) > 1:
        axis.legend(loc="upper left", bbox_to_anchor=(1.0, 1.0))
    axis.margins(x=0)


def plot_table(path, out):
    """One panel per unit over time; returns the picture's path or None if the table holds no rows."""
    table = read_table(path)
    if "t" not in table:
        return None
    groups = by_unit([c for c in table.values() if c.name not in UNPLOTTED and np.any(np.isfinite(c.values))])
    if not groups:
        return None
    figure, axes = plt.subplots(len(groups), 1, figsize=(9, 0.6 + 2.2 * len(groups)), sharex=True, squeeze=False)
    for axis, ((kind, logarithmic), columns) in zip(axes[:, 0], groups.items()):
        plot_group(axis, table["t"], kind, logarithmic, columns)
    axes[-1, 0].set_xlabel(table["t"].label)
    axes[0, 0].set_title(path.stem, loc="left", fontweight="bold")
    return save(figure, out / f"{path.stem}.png")


# ---- series of snapshots --------------------------------------------------------------------------------------------

@dataclass
class Instant:
    time: float
    path: Path


def read_index(pvd):
    """The instants of a .pvd file whose files are there."""
    sets = xml.parse(pvd).getroot().iter("DataSet")
    instants = [Instant(float(s.get("timestep")), pvd.parent / s.get("file")) for s in sets]
    return [i for i in instants if i.path.exists()]


def equally_spaced(instants, count):
    """At most `count` instants, equally spaced, the last one always among them."""
    if len(instants) <= count:
        return instants
    return [instants[i] for i in np.linspace(0, len(instants) - 1, count).round().astype(int)]


@dataclass
class Sheet:
    points: np.ndarray      # (n, 3)
    triangles: np.ndarray   # (m, 3)

    def area_vectors(self):
        a, b, c = (self.points[self.triangles[:, i]] for i in range(3))
        return 0.5 * np.cross(b - a, c - a)

    def cut(self, axis, position):
        """Segments (m, 2, 3) along which the plane x_axis = position cuts the triangles."""
        corners = self.points[self.triangles]
        distance = corners[:, :, axis] - position
        crossed = (distance < 0).any(axis=1) & (distance >= 0).any(axis=1)
        segments = []
        for x, d in zip(corners[crossed], distance[crossed]):
            below = d < 0
            ends = [x[i] + d[i] / (d[i] - d[j]) * (x[j] - x[i]) for i, j in ((0, 1), (1, 2), (2, 0)) if below[i] != below[j]]
            segments.append(ends)
        return np.array(segments).reshape(-1, 2, 3)


def read_sheet(path):
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(str(path))
    reader.Update()
    data = reader.GetOutput()
    return Sheet(vtk_to_numpy(data.GetPoints().GetData()).astype(float),
                 vtk_to_numpy(data.GetPolys().GetConnectivityArray()).reshape(-1, 3))


def nearest(instants, time):
    return min(instants, key=lambda instant: abs(instant.time - time))


# ---- the plane that is shown ----------------------------------------------------------------------------------------

@dataclass
class Plane:
    normal: int         # axis it is normal to
    position: float     # along that axis

    @property
    def axes(self):
        return [a for a in range(3) if a != self.normal]


def mid_plane(sheets, normal=None, box=None, box_decides=False):
    """Through the middle of the sheets along the axis that their normals keep clear of; z where several do.

    Without sheets, through the middle of the box (low, high), across z or, if `box_decides`, its shortest side."""
    if not sheets:
        low, high = box
        if normal is None:
            normal = int(np.argmin(high - low)) if box_decides else 2
        return Plane(normal, 0.5 * (low[normal] + high[normal]))
    points = np.vstack([sheet.points for sheet in sheets])
    if normal is None:
        share = np.sum([np.abs(sheet.area_vectors()).sum(axis=0) for sheet in sheets], axis=0)
        normal = max(a for a in range(3) if share[a] <= share.min() + 1e-6 * share.sum())
    middle = 0.5 * (points[:, normal].min() + points[:, normal].max())
    is_rounding = abs(middle) < 1e-9 * np.ptp(points, axis=0).max()
    return Plane(normal, 0.0 if is_rounding else middle)


# ---- flow -----------------------------------------------------------------------------------------------------------

@dataclass
class Slice:
    centres: list           # coordinates along the plane's two axes
    plane: Plane            # through the cells' centres
    vorticity: np.ndarray   # component along the normal, (second axis, first axis); NaN outside of a curvilinear grid
    velocity: np.ndarray    # mean over the slice, 3 components


FLOW_READERS = {".vtr": vtkXMLRectilinearGridReader, ".pvtr": vtkXMLPRectilinearGridReader,
                ".vts": vtkXMLStructuredGridReader, ".pvts": vtkXMLPStructuredGridReader}


def is_curvilinear(path):
    return path.suffix in (".vts", ".pvts")


def flow_reader(path):
    reader = FLOW_READERS[path.suffix]()
    reader.SetFileName(str(path))
    reader.UpdateInformation()
    arrays = reader.GetCellDataArraySelection()
    arrays.DisableAllArrays()
    for name in ("vorticity", "velocity"):
        arrays.EnableArray(name)
    return reader


def whole_box(path):
    reader = flow_reader(path)
    reader.Update()
    return np.array(reader.GetOutput().GetBounds()).reshape(3, 2).T


def node_coordinates(grid):
    return [vtk_to_numpy(getattr(grid, f"Get{axis}Coordinates")()) for axis in "XYZ"]


def read_slice(path, plane):
    """The layer of cells around the plane; of a curvilinear grid, values on a raster in the plane."""
    return read_raster(path, plane) if is_curvilinear(path) else read_layer(path, plane)


def read_raster(path, plane, longest=400):
    """Values at points of the plane, `longest` of them along the longer side of the grid."""
    reader = flow_reader(path)
    to_points = vtkCellDataToPointData()
    to_points.SetInputConnection(reader.GetOutputPort())
    to_points.Update()
    grid = to_points.GetOutput()
    if grid.GetPointData().GetArray("vorticity") is None:
        return None
    low, high = np.array(grid.GetBounds()).reshape(3, 2).T
    spacing = (high - low)[plane.axes].max() / longest
    counts, origin, spacings = [1, 1, 1], [0.0, 0.0, 0.0], [1.0, 1.0, 1.0]
    origin[plane.normal] = plane.position
    for a in plane.axes:
        counts[a] = max(2, int(np.ceil((high[a] - low[a]) / spacing)))
        spacings[a] = (high[a] - low[a]) / counts[a]
        origin[a] = low[a] + 0.5 * spacings[a]
    raster = vtkImageData()
    raster.SetDimensions(counts)
    raster.SetOrigin(origin)
    raster.SetSpacing(spacings)
    probe = vtkProbeFilter()
    probe.SetSourceData(grid)
    probe.SetInputData(raster)
    probe.Update()
    data = probe.GetOutput().GetPointData()
    shape = tuple(counts[a] for a in reversed(plane.axes))
    inside = vtk_to_numpy(data.GetArray(probe.GetValidPointMaskArrayName())).reshape(shape) > 0
    vorticity = vtk_to_numpy(data.GetArray("vorticity"))[:, plane.normal].reshape(shape)
    velocity = data.GetArray("velocity")
    mean = vtk_to_numpy(velocity)[inside.ravel()].mean(axis=0) if velocity is not None and inside.any() else np.zeros(3)
    centres = [origin[a] + spacings[a] * np.arange(counts[a]) for a in plane.axes]
    return Slice(centres, plane, np.where(inside, vorticity, np.nan), mean)


def read_layer(path, plane):
    reader = flow_reader(path)
    reader.Update()
    grid = reader.GetOutput()
    nodes = node_coordinates(grid)
    n = plane.normal
    layer = int(np.clip(np.searchsorted(nodes[n], plane.position, side="right") - 1, 0, len(nodes[n]) - 2))
    cells = [len(x) - 1 for x in nodes]
    centres = [0.5 * (x[1:] + x[:-1]) for x in nodes]

    def layer_of(name):
        array = grid.GetCellData().GetArray(name)
        if array is None:
            return None
        values = vtk_to_numpy(array).reshape(cells[2], cells[1], cells[0], -1)
        return np.take(values, layer, axis=2 - n)

    vorticity, velocity = layer_of("vorticity"), layer_of("velocity")
    if vorticity is None:
        return None
    return Slice([centres[a] for a in plane.axes], Plane(n, centres[n][layer]), vorticity[..., n],
                 np.zeros(3) if velocity is None else velocity.mean(axis=(0, 1)))


def view_near(sheets, flow):
    """Limits of both axes of the plane: around the sheets and some way downstream, within the grid."""
    low = np.array([x[0] for x in flow.centres])
    high = np.array([x[-1] for x in flow.centres])
    if not sheets:
        return low, high
    axes = flow.plane.axes
    points = np.vstack([sheet.points for sheet in sheets])[:, axes]
    box_low, box_high = points.min(axis=0), points.max(axis=0)
    size = (box_high - box_low).max()
    before, after = np.full(2, 0.9 * size), np.full(2, 0.9 * size)
    velocity = flow.velocity[axes]
    stream = int(np.argmax(np.abs(velocity)))
    (after if velocity[stream] >= 0 else before)[stream] = 3.0 * size
    return np.maximum(low, box_low - before), np.minimum(high, box_high + after)


def largest_shown(slices, limits):
    """Colour limit: what all but one in a hundred of the visible cells stay below."""
    low, high = limits
    visible = []
    for flow in slices:
        inside = [(x >= lo) & (x <= hi) for x, lo, hi in zip(flow.centres, low, high)]
        visible.append(np.abs(flow.vorticity[np.ix_(inside[1], inside[0])]).ravel())
    limit = float(np.nanpercentile(np.concatenate(visible), 99)) if visible else 0.0
    return limit if limit > 0 else 1.0


def draw_sections(axis, sheets, plane, colour="black", width=2.2):
    segments = [sheet.cut(plane.normal, plane.position)[:, :, plane.axes] for sheet in sheets]
    if segments:
        axis.add_collection(LineCollection(np.concatenate(segments), colors=[colour], linewidths=width, capstyle="round"))


def draw_vorticity(axis, flow, sheets, limits, colour_limit, time):
    shading = "nearest" if np.isnan(flow.vorticity).any() else "gouraud"
    image = axis.pcolormesh(*flow.centres, flow.vorticity, shading=shading, cmap="RdBu_r", vmin=-colour_limit,
                            vmax=colour_limit, rasterized=True)
    draw_sections(axis, sheets, flow.plane)
    axis.set_aspect("equal")
    axis.grid(False)
    axis.set_xlim(limits[0][0], limits[1][0])
    axis.set_ylim(limits[0][1], limits[1][1])
    axis.set_title(f"t = {time:.4g}", fontsize=10)
    return image


def coordinate_label(axis):
    return f"{AXES[axis]} [length]"


def colour_bar(figure, image, axes, plane):
    bar = figure.colorbar(image, ax=axes, shrink=0.75, pad=0.02, extend="both")
    bar.set_label(rf"vorticity $\omega_{AXES[plane.normal]}$ [1/time]")
    bar.outline.set_visible(False)


def panel_grid(count, limits):
    """Rows and columns, and the figure's size, for panels of the view's shape."""
    extent = limits[1] - limits[0]
    aspect = extent[1] / extent[0]
    columns = 1 if count == 1 else 3 if aspect > 0.5 and count > 4 else 2
    rows = -(-count // columns)
    width = 9.0 if columns == 1 else 4.6 * columns
    panel = 0.84 * width / columns   # what the colour bar and the labels leave
    return rows, columns, (width, max(2.5, (panel * aspect + 0.4) * rows + 0.4))


def vorticity_figure(frames, limits, path):
    """frames: (time, slice, sheets) of each panel."""
    rows, columns, size = panel_grid(len(frames), limits)
    figure, axes = plt.subplots(rows, columns, figsize=size, squeeze=False, sharex=True, sharey=True,
                                constrained_layout=True)
    colour_limit = largest_shown([flow for _, flow, _ in frames], limits)
    for axis, (time, flow, sheets) in zip(axes.flat, frames):
        image = draw_vorticity(axis, flow, sheets, limits, colour_limit, time)
    for axis in axes.flat[len(frames):]:
        axis.set_visible(False)
    figure.supxlabel(coordinate_label(flow.plane.axes[0]), fontsize=10)
    figure.supylabel(coordinate_label(flow.plane.axes[1]), fontsize=10)
    colour_bar(figure, image, axes, flow.plane)
    return save(figure, path)


def plot_vorticity(flow_instants, surfaces, count, normal, out):
    chosen = equally_spaced(flow_instants, count)
    sheets_at = {i.time: [read_sheet(nearest(s, i.time).path) for s in surfaces] for i in chosen}
    everything = [sheet for sheets in sheets_at.values() for sheet in sheets]
    last = chosen[-1].path
    plane = mid_plane(everything, normal, None if everything else whole_box(last), box_decides=is_curvilinear(last))
    frames = [(i.time, read_slice(i.path, plane), sheets_at[i.time]) for i in chosen]
    if any(flow is None for _, flow, _ in frames):
        return []
    limits = view_near(everything, frames[-1][1])
    pictures = [vorticity_figure(frames[-1:], limits, out / "vorticity.png")]
    if len(frames) > 1:
        pictures.append(vorticity_figure(frames, limits, out / "vorticity-instants.png"))
    return pictures


# ---- sheets ---------------------------------------------------------------------------------------------------------

def plot_shapes(surfaces, normal, out, count=16):
    """Mid-sections of all sheets over time; None if nothing moves."""
    chosen = [equally_spaced(instants, count) for instants in surfaces]
    shapes = [[(i.time, read_sheet(i.path)) for i in instants] for instants in chosen]
    everything = [sheet for series in shapes for _, sheet in series]
    if all(np.array_equal(series[0][1].points, sheet.points) for series in shapes for _, sheet in series):
        return None
    plane = mid_plane(everything, normal)
    times = [time for series in shapes for time, _ in series]
    scale = plt.Normalize(min(times), max(times))
    figure, axis = plt.subplots(figsize=(8, 5), constrained_layout=True)
    for series in shapes:
        for time, sheet in series:
            draw_sections(axis, [sheet], plane, colour=plt.cm.viridis(scale(time)), width=1.6)
    axis.autoscale()
    axis.set_aspect("equal", adjustable="datalim")
    axis.set_title(f"sheets cut by the plane {AXES[plane.normal]} = {plane.position:.4g}", loc="left", fontweight="bold")
    axis.set_xlabel(coordinate_label(plane.axes[0]))
    axis.set_ylabel(coordinate_label(plane.axes[1]))
    bar = figure.colorbar(plt.cm.ScalarMappable(scale, "viridis"), ax=axis, shrink=0.75, pad=0.02)
    bar.set_label("t [time]")
    return save(figure, out / "shapes.png")


# ---- a run ----------------------------------------------------------------------------------------------------------

def save(figure, path):
    figure.savefig(path)
    plt.close(figure)
    return path


def surfaces_of(run):
    """The series of every sheet and body: lists of instants that are not empty."""
    series = [read_index(pvd) for pvd in sorted(run.glob("*.pvd")) if pvd.name != "fields.pvd"]
    return [instants for instants in series if instants]


def plot_run(run, count, normal):
    """Makes all pictures of a run and returns their paths."""
    out = run / "plots"
    out.mkdir(exist_ok=True)
    tables = sorted(run.glob("probe-*.csv")) + sorted(run.glob("forces-*.csv")) + [p for p in [run / "steps.csv"] if p.exists()]
    pictures = [plot_table(path, out) for path in tables]
    surfaces = surfaces_of(run)
    flow = read_index(run / "fields.pvd") if (run / "fields.pvd").exists() else []
    if flow:
        pictures += plot_vorticity(flow, surfaces, count, normal, out)
    if surfaces:
        pictures.append(plot_shapes(surfaces, normal, out))
    return [path for path in pictures if path]


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("run", type=Path, help="folder of a run, such as runs/flag/001")
    arguments.add_argument("--instants", type=int, default=6, help="panels of vorticity-instants.png (default 6)")
    arguments.add_argument("--normal", choices=list(AXES), help="axis the plane is normal to (default: chosen by the sheets)")
    options = arguments.parse_args()
    if not options.run.is_dir():
        sys.exit(f"plot: {options.run} is not a folder; give the folder of a run, such as runs/flag/001")
    vtkObject.GlobalWarningDisplayOff()
    pictures = plot_run(options.run, max(1, options.instants), AXES.index(options.normal) if options.normal else None)
    if not pictures:
        sys.exit(f"plot: {options.run} holds nothing to draw yet: no table with rows, no fields.pvd, no shell-*.pvd")
    for path in pictures:
        print(path)


if __name__ == "__main__":
    main()
