"""A plugin of ParaView: volumes and stores as images, their objects as closed surfaces, their tree as a graph.

Tools > Manage Plugins > Load New: this file; or the environment variable PV_PLUGIN_PATH names its folder. The program isoatlas does the work,
so that any ParaView's own Python will do: it is sought in PATH, or named by ISOATLAS_PROGRAM. Written for ParaView 5.10 to 5.13, tested with 5.11.
"""
import json
import os
import shutil
import subprocess
import tempfile

from paraview.util.vtkAlgorithm import VTKPythonAlgorithmBase, smdomain, smhint, smproperty, smproxy
from vtkmodules.vtkCommonCore import vtkDoubleArray, vtkIdTypeArray, vtkOutputWindow
from vtkmodules.vtkCommonDataModel import vtkImageData, vtkPolyData, vtkUnstructuredGrid
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline
from vtkmodules.vtkIOXML import vtkXMLImageDataReader, vtkXMLPolyDataReader, vtkXMLUnstructuredGridReader

EXTENSIONS = "atlas nrrd nhdr nii nii.gz mha mhd vti npy"
DESCRIPTION = "Scalar volumes and stores, isoatlas"
ALL = 10**9  # lines of a table


class Failed(Exception):
    """The program refused; its sentence and the next step."""


def run(*words):
    """What the program prints as JSON."""
    program = os.environ.get("ISOATLAS_PROGRAM") or shutil.which("isoatlas")
    if not program:
        raise Failed("isoatlas: the program is not in PATH\n  next: install it, or name it in the environment variable ISOATLAS_PROGRAM")
    clean = {name: value for name, value in os.environ.items() if name != "LD_LIBRARY_PATH"}  # that of ParaView's own libraries
    done = subprocess.run([program, *map(str, words), "--json", "--quiet"], capture_output=True, text=True, env=clean)
    if done.returncode != 0:
        raise Failed(done.stderr.strip() or f"isoatlas ended with {done.returncode}")
    return json.loads(done.stdout)


def read_with(reader, data, *words):
    """What the program writes to a temporary file, read into `data`; and what it prints."""
    endings = {vtkXMLImageDataReader: ".vti", vtkXMLPolyDataReader: ".vtp", vtkXMLUnstructuredGridReader: ".vtu"}
    with tempfile.TemporaryDirectory(prefix="isoatlas-") as folder:
        path = os.path.join(folder, "part" + endings[reader])
        said = run(*words, "-o", path)
        source = reader()
        source.SetFileName(path)
        source.Update()
        data.ShallowCopy(source.GetOutput())
    return said


class Algorithm(VTKPythonAlgorithmBase):
    """Produces one data set from a file; errors go to the output window."""

    def __init__(self, kind):
        super().__init__(nInputPorts=0, nOutputPorts=1, outputType=kind)
        self.path = None

    def set(self, name, value):
        if getattr(self, name) != value:
            setattr(self, name, value)
            self.Modified()

    def attempt(self, work):
        if not self.path or self.path == "None":
            return 0
        try:
            work()
        except Failed as error:
            vtkOutputWindow.GetInstance().DisplayErrorText(f"{error}\n")
            return 0
        return 1


@smproxy.reader(name="isoatlasVolume", label="isoatlas volume", extensions=EXTENSIONS, file_description=DESCRIPTION)
class VolumeReader(Algorithm):
    """The samples of a volume or a store."""

    def __init__(self):
        super().__init__("vtkImageData")

    @smproperty.stringvector(name="FileName")
    @smdomain.filelist()
    @smhint.filechooser(extensions=EXTENSIONS, file_description=DESCRIPTION)
    def SetFileName(self, path):
        self.set("path", path)

    def RequestInformation(self, request, inputs, outputs):
        def work():
            size = run("info", self.path)["volume"]["dims"]
            extent = [bound for n in (*size, 1, 1)[:3] for bound in (0, n - 1)]
            outputs.GetInformationObject(0).Set(vtkStreamingDemandDrivenPipeline.WHOLE_EXTENT(), extent, 6)
        return self.attempt(work)

    def RequestData(self, request, inputs, outputs):
        return self.attempt(lambda: read_with(vtkXMLImageDataReader, vtkImageData.GetData(outputs), "convert", self.path))


@smproxy.source(name="isoatlasObjects", label="isoatlas objects")
class Objects(Algorithm):
    """Closed surfaces of objects, each at its best isovalue or at the one that is given, with number, id, isovalue and genus of each triangle."""

    def __init__(self):
        super().__init__("vtkPolyData")
        self.references, self.top, self.polarity = "", 5, "high"

    @smproperty.stringvector(name="FileName")
    @smdomain.filelist()
    @smhint.filechooser(extensions=EXTENSIONS, file_description=DESCRIPTION)
    def SetFileName(self, path):
        self.set("path", path)

    @smproperty.stringvector(name="Objects", default_values="")
    def SetObjects(self, references):
        """As the command line names them, with spaces between: 1 3 5@120; empty: the first ones of the table."""
        self.set("references", references or "")

    @smproperty.intvector(name="Top", default_values=5)
    @smdomain.intrange(min=1, max=1000)
    def SetTop(self, top):
        """So many of the table, where Objects is empty."""
        self.set("top", top)

    @smproperty.stringvector(name="Polarity", default_values="high")
    def SetPolarity(self, polarity):
        """high or low: objects of high values, or of low ones."""
        self.set("polarity", polarity)

    def RequestData(self, request, inputs, outputs):
        return self.attempt(lambda: vtkPolyData.GetData(outputs).ShallowCopy(self.made()))

    def made(self):
        output = vtkPolyData()
        chosen = [word for reference in self.references.split() for word in ("--object", reference)] or ["--top", self.top]
        volume = [self.path, "--polarity", self.polarity]
        found = read_with(vtkXMLPolyDataReader, output, "extract", *volume, *chosen)["surfaces"]
        genus = {}
        for tau in sorted({one["tau"] for one in found}):
            for one in run("objects", *volume, "--tau", repr(tau), "--top", ALL)["objects"]:
                genus[one["id"], tau] = sum(contour["genus"] for contour in one["contours"])
        part = output.GetPointData().GetArray("Object")  # which of several surfaces, from 1
        columns = {"Number": lambda one: one["number"] or 0, "Id": lambda one: one["id"], "Isovalue": lambda one: one["tau"],
                   "Genus": lambda one: genus.get((one["id"], one["tau"]), -1)}
        for name, value in columns.items():
            array = vtkDoubleArray() if name == "Isovalue" else vtkIdTypeArray()
            array.SetName(name)
            array.SetNumberOfTuples(output.GetNumberOfCells())
            values = [value(one) for one in found]
            for cell in range(output.GetNumberOfCells()):
                point = output.GetCell(cell).GetPointId(0)
                array.SetValue(cell, values[0 if part is None else int(part.GetValue(point)) - 1])
            output.GetCellData().AddArray(array)
        return output


@smproxy.source(name="isoatlasTree", label="isoatlas tree")
class Tree(Algorithm):
    """The criticality tree: points are events, lines lead from each to the one it becomes part of."""

    def __init__(self):
        super().__init__("vtkUnstructuredGrid")
        self.detail = "events"

    @smproperty.stringvector(name="FileName")
    @smdomain.filelist()
    @smhint.filechooser(extensions=EXTENSIONS, file_description=DESCRIPTION)
    def SetFileName(self, path):
        self.set("path", path)

    @smproperty.stringvector(name="Detail", default_values="events")
    def SetDetail(self, detail):
        """events, levels, elements or contours: docs/cli.md."""
        self.set("detail", detail)

    def RequestData(self, request, inputs, outputs):
        output = vtkUnstructuredGrid.GetData(outputs)
        return self.attempt(lambda: read_with(vtkXMLUnstructuredGridReader, output, "tree", self.path, "--detail", self.detail))
