"""HDF5 files in which nothing is believed: arrays that lie in their file, or in the segments of their run, and no others.

A crafted file cannot make a reader open what it names: links other than hard ones, files elsewhere, filters and virtual
datasets over anything but segments are refused, and so is an extent that the bytes on disk cannot fill.
"""

import os
import re

import h5py

SEGMENT = re.compile(r"segments/[0-9]{6,}\.h5")


class NotPlain(Exception):
    """An object that is not as the program writes it; the message begins with its name."""


def has_hard_link(group, name):
    """Whether something of the group's own file has that name in it."""
    try:
        return isinstance(group.get(name, getlink=True), h5py.HardLink)
    except TypeError:  # a kind of link that h5py does not know
        return False


def find_dataset(file, name):
    """The array of that name, reached over hard links alone and stored in one piece inside the file, or virtual."""
    place = ""
    for part in name.strip("/").split("/"):
        place += "/" + part
        try:
            link = file.get(place, getlink=True)
        except TypeError:  # a kind of link that h5py does not know
            link = h5py.SoftLink("")
        if link is None:
            raise NotPlain(f"{place} is not there")
        if not isinstance(link, h5py.HardLink):
            raise NotPlain(f"{place} is a link to another place")
    found = file[name]
    if not isinstance(found, h5py.Dataset) or found.shape is None or found.dtype.kind not in "fi":
        raise NotPlain(f"{name} is no array of numbers")
    if not found.is_virtual:
        check_storage(found, name)
    return found


def check_storage(dataset, name):
    creation = dataset.id.get_create_plist()
    if creation.get_external_count():
        raise NotPlain(f"{name} is to come from another file")
    if creation.get_layout() != h5py.h5d.CONTIGUOUS or creation.get_nfilters():
        raise NotPlain(f"{name} is not stored in one piece")
    n_bytes = dataset.size * dataset.dtype.itemsize
    if n_bytes and (n_bytes != dataset.id.get_storage_size() or n_bytes > os.path.getsize(dataset.file.filename)):
        raise NotPlain(f"{name} is larger than the file")


def check_sources(dataset, name, folder):
    """Every row of a virtual array is a row of a plain one in a segment."""
    n_values = 0
    for source in dataset.virtual_sources():
        if not SEGMENT.fullmatch(source.file_name):
            raise NotPlain(f"{name} is to come from {source.file_name[:60]!r}, which is no segment")
        with h5py.File(os.path.join(folder, source.file_name), "r") as segment:
            rows = find_dataset(segment, source.dset_name)
            if rows.is_virtual or rows.dtype != dataset.dtype or rows.shape[1:] != dataset.shape[1:]:
                raise NotPlain(f"{source.dset_name} in {source.file_name} does not fit {name}")
            n_values += rows.size
    if n_values != dataset.size:
        raise NotPlain(f"{name} has {dataset.size} numbers, and its segments hold {n_values}")


def check_file(file):
    """That every object can be used: all links are hard, and all arrays plain."""

    def visit(group, path):
        for name in group:
            link = group.get(name, getlink=True)
            place = f"{path}/{name}"
            if not isinstance(link, h5py.HardLink):
                raise NotPlain(f"{place} is a link to another place")
            if isinstance(group[name], h5py.Group):
                visit(group[name], place)
            elif find_dataset(file, place).is_virtual:
                raise NotPlain(f"{place} is to come from another file")

    visit(file, "")
