"""A scripted module of 3D Slicer: the objects of a volume as a segmentation, each at its own best isovalue.

Edit > Application Settings > Modules > Additional module paths: this folder. The program isoatlas does the work: it is sought in PATH, or named
in the module. Segments have the names and colours of the table; the isovalue of each is in its tag "isoatlas.isovalue". Written for Slicer 5.0 to 5.8.
"""
import json
import os
import shutil
import subprocess
import tempfile

import slicer
from slicer.ScriptedLoadableModule import ScriptedLoadableModule, ScriptedLoadableModuleLogic, ScriptedLoadableModuleWidget

DEFAULT_TOP = 24


class Isoatlas(ScriptedLoadableModule):
    def __init__(self, parent):
        super().__init__(parent)
        parent.title = "Objects (isoatlas)"
        parent.categories = ["Segmentation"]
        parent.contributors = ["isoatlas"]
        parent.helpText = "Which objects are in a volume, and at which isovalues? Each becomes a segment at its own best isovalue."


class IsoatlasWidget(ScriptedLoadableModuleWidget):
    def setup(self):
        super().setup()
        import ctk
        import qt
        self.logic = IsoatlasLogic()
        form = qt.QFormLayout()
        self.layout.addLayout(form)
        self.volume = slicer.qMRMLNodeComboBox()
        self.volume.nodeTypes = ["vtkMRMLScalarVolumeNode"]
        self.volume.addEnabled = self.volume.removeEnabled = False
        self.volume.setMRMLScene(slicer.mrmlScene)
        self.top = qt.QSpinBox()
        self.top.setRange(1, 1000)
        self.top.setValue(DEFAULT_TOP)
        self.polarity = qt.QComboBox()
        self.polarity.addItems(["high", "low"])
        self.program = ctk.ctkPathLineEdit()
        self.program.currentPath = shutil.which("isoatlas") or ""
        for name, part in (("Volume", self.volume), ("Objects", self.top), ("Values", self.polarity), ("Program", self.program)):
            form.addRow(name, part)
        self.find = qt.QPushButton("Find objects")
        self.find.connect("clicked(bool)", self.onFind)
        self.layout.addWidget(self.find)
        self.layout.addStretch(1)

    def onFind(self, *_):
        with slicer.util.tryWithErrorDisplay("The objects were not found.", waitCursor=True):
            self.logic.segment(self.volume.currentNode(), top=self.top.value, polarity=self.polarity.currentText,
                               program=self.program.currentPath)


class IsoatlasLogic(ScriptedLoadableModuleLogic):
    """Without a window."""

    def segment(self, volume, top=DEFAULT_TOP, polarity="high", program=""):
        """A segmentation of the first `top` objects of a volume, and what the program said of it. Raises RuntimeError with its sentence."""
        if volume is None:
            raise RuntimeError("no volume is chosen\n  next: choose one, or load it first")
        program = program or shutil.which("isoatlas")
        if not program:
            raise RuntimeError("the program isoatlas is not in PATH\n  next: install it, or choose it beside Program")
        with tempfile.TemporaryDirectory(prefix="isoatlas-") as folder:
            source, labels = os.path.join(folder, "volume.nrrd"), os.path.join(folder, "objects.seg.nrrd")
            if not slicer.util.saveNode(volume, source, {"useCompression": False}):
                raise RuntimeError("the volume cannot be written\n  next: free some space for temporary files")
            said = self.run(program, "label", source, "--top", str(top), "--polarity", polarity, "-o", labels)
            node = slicer.util.loadSegmentation(labels, {"name": f"{volume.GetName()} objects"})
        node.SetReferenceImageGeometryParameterFromVolumeNode(volume)
        node.CreateClosedSurfaceRepresentation()
        return node, said

    @staticmethod
    def run(program, *words):
        clean = slicer.util.startupEnvironment()  # without Slicer's own libraries
        done = subprocess.run([program, *words, "--json", "--quiet"], capture_output=True, text=True, env=clean)
        if done.returncode != 0:
            raise RuntimeError(done.stderr.strip() or f"isoatlas ended with {done.returncode}")
        return json.loads(done.stdout)
