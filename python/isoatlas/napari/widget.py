"""The dock widget: a table of objects, and a slider for the isovalue of the one that is chosen."""
from __future__ import annotations

from typing import Any, Optional

from qtpy.QtCore import Qt, QTimer  # type: ignore[import-not-found, unused-ignore]
from qtpy.QtWidgets import (  # type: ignore[import-not-found, unused-ignore]
    QAbstractItemView, QComboBox, QHBoxLayout, QLabel, QProgressBar, QPushButton, QSlider, QTableWidget, QTableWidgetItem, QVBoxLayout, QWidget)

from .._objects import Object
from ..errors import Error
from .model import Cancelled, Job, Model

STEPS = 200  #: of the slider
COLUMNS = ("object", "best isovalue", "voxels", "tunnels", "cavities", "why")


class ObjectsWidget(QWidget):  # type: ignore[misc, unused-ignore]
    """Objects of an image. viewer: that of napari, which passes it by this name."""

    def __init__(self, napari_viewer: Any) -> None:
        super().__init__()
        self.model = Model(napari_viewer)
        self.job: Optional[Job[Any]] = None
        self.images, self.polarity = QComboBox(), QComboBox()
        self.polarity.addItems(["high", "low"])
        self.find, self.cancel = QPushButton("Find objects"), QPushButton("Cancel")
        self.progress, self.message = QProgressBar(), QLabel("")
        self.message.setWordWrap(True)
        self.table = QTableWidget(0, len(COLUMNS))
        self.table.setHorizontalHeaderLabels(list(COLUMNS))
        self.table.setSelectionBehavior(QAbstractItemView.SelectRows)
        self.table.setEditTriggers(QAbstractItemView.NoEditTriggers)
        self.surface, self.labels = QPushButton("Surface"), QPushButton("Labels")
        self.slider, self.isovalue = QSlider(Qt.Horizontal), QLabel("")
        self.slider.setRange(0, STEPS)
        self._lay_out()
        self.find.clicked.connect(self.start)
        self.cancel.clicked.connect(lambda *_: self.job.cancel() if self.job is not None else None)
        self.table.itemSelectionChanged.connect(self.choose)
        self.surface.clicked.connect(lambda *_: self.attempt(self.show_surfaces))
        self.labels.clicked.connect(lambda *_: self.attempt(lambda: self.model.show_labels(self.chosen())))
        self.slider.valueChanged.connect(lambda *_: self.attempt(self.slide))
        self.timer = QTimer(self)
        self.timer.timeout.connect(self.look)
        napari_viewer.layers.events.inserted.connect(lambda *_: self.list_images())
        napari_viewer.layers.events.removed.connect(lambda *_: self.list_images())
        self.list_images()
        self.enable()

    def _lay_out(self) -> None:
        whole = QVBoxLayout()
        for row in ((self.images, self.polarity, self.find, self.cancel), (self.progress,), (self.message,), (self.table,),
                    (self.surface, self.labels), (self.slider, self.isovalue)):
            line = QHBoxLayout()
            for part in row:
                line.addWidget(part)
            whole.addLayout(line)
        self.setLayout(whole)

    def list_images(self) -> None:
        """The names of the images, the one that was chosen stays chosen."""
        name = self.images.currentText()
        names = [layer.name for layer in self.model.images()]
        self.images.clear()
        self.images.addItems(names)
        if name in names:
            self.images.setCurrentIndex(names.index(name))
        self.enable()

    def enable(self) -> None:
        busy = self.job is not None
        self.find.setEnabled(not busy and self.images.count() > 0)
        self.cancel.setEnabled(busy)
        self.progress.setVisible(busy)
        one = self.one()
        for part in (self.surface, self.labels):
            part.setEnabled(not busy and len(self.model.objects) > 0)
        self.slider.setEnabled(not busy and one is not None)

    def attempt(self, work: Any) -> Any:
        """Errors are said in the widget, with the next step."""
        try:
            self.message.setText("")
            return work()
        except (Error, ValueError, LookupError, MemoryError) as error:
            self.message.setText(str(error))

    def start(self, *_: Any) -> None:
        chosen = [layer for layer in self.model.images() if layer.name == self.images.currentText()]
        if chosen:
            self.job = self.attempt(lambda: self.model.seek(chosen[0], self.polarity.currentText()))
        if self.job is not None:
            self.timer.start(50)
        self.enable()

    def look(self) -> None:
        """Shows how far the job is, and what it has found."""
        if self.job is None:
            return
        self.progress.setValue(int(100 * self.job.part))
        self.progress.setFormat(self.job.phase)
        if not self.job.done:
            return
        job, self.job = self.job, None
        self.timer.stop()
        try:
            found = self.attempt(job.result)
        except Cancelled:
            found = None
            self.message.setText("Cancelled.")
        if found is not None:
            self.model.take(found)
            self.fill()
        self.enable()

    def fill(self) -> None:
        objects = self.model.objects
        self.table.setRowCount(len(objects))
        for row, one in enumerate(objects):
            cells = (str(one.number), f"{one.best_tau:g}", f"{one.voxels:,}", str(one.tunnels), str(one.cavities), one.why or one.note)
            for column, text in enumerate(cells):
                self.table.setItem(row, column, QTableWidgetItem(text))
        self.message.setText("" if len(objects) else "No object is above the noise level.")

    def chosen(self) -> list[Object]:
        return [self.model.objects[row] for row in sorted({index.row() for index in self.table.selectedIndexes()})]

    def one(self) -> Optional[Object]:
        """The object whose isovalue the slider sets: there is one if one row is chosen."""
        found = self.chosen()
        return found[0] if len(found) == 1 else None

    def choose(self) -> None:
        one = self.one()
        self.enable()
        if one is None:
            return
        low, high = self.model.isovalues(one)
        self.slider.blockSignals(True)
        self.slider.setValue(round(STEPS * (one.best_tau - low) / (high - low)) if high > low else 0)
        self.slider.blockSignals(False)
        self.isovalue.setText(f"{one.best_tau:g}")

    def show_surfaces(self) -> None:
        for one in self.model.or_all(self.chosen()):
            self.model.show_surface(one)

    def slide(self) -> None:
        one = self.one()
        if one is None:
            return
        low, high = self.model.isovalues(one)
        tau = low + (high - low) * self.slider.value() / STEPS
        self.isovalue.setText(f"{tau:g}")
        self.model.show_surface(one, tau)
