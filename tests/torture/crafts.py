"""What can be done to an object of an HDF5 file whose seal is then made right again.

A craft of an array is a function (file, name, draw); a craft of an attribute takes (file, object, name, draw).
"""

import h5py
import numpy as np


def replace(file, name, values):
    """The array once more, contiguous, with the attributes that it had."""
    attributes = dict(file[name].attrs)
    del file[name]
    file.create_dataset(name, data=values).attrs.update(attributes)


def remove(file, name, draw):
    del file[name]


def make_group(file, name, draw):
    del file[name]
    file.create_group(name)


def add_axis(file, name, draw):
    replace(file, name, file[name][()][..., None])


def flatten(file, name, draw):
    values = file[name][()]
    replace(file, name, values.ravel() if values.ndim > 1 else values[:1].reshape(()))


def add_rows(file, name, draw):
    values = file[name][()]
    replace(file, name, np.concatenate([values, np.repeat(values[-1:], draw.choice([1, 1000]), axis=0)]))


def remove_row(file, name, draw):
    replace(file, name, file[name][:-1])


def remove_rows(file, name, draw):
    replace(file, name, file[name][:0])


def widen(file, name, draw):
    values = file[name][()]
    replace(file, name, np.concatenate([values, values], axis=-1))


def change_type(file, name, draw):
    values = file[name][()]
    kinds = ["f2", "i1", "u8", ">f8", "S5", "c16", [("a", "i4"), ("b", "f8")], "i8" if values.dtype.kind == "f" else "f8"]
    kind = draw.choice(kinds)
    replace(file, name, np.zeros(values.shape, dtype=kind) if isinstance(kind, list) else
            np.nan_to_num(values).astype(kind))


def make_texts(file, name, draw):
    shape = file[name].shape
    del file[name]
    file.create_dataset(name, data=np.full(shape, "A" * 200, dtype=object), dtype=h5py.string_dtype())


def make_empty(file, name, draw):
    del file[name]
    file[name] = h5py.Empty("f8")


def spoil(file, name, draw):
    """A number that is none, or a count that cannot be."""
    values = file[name][()]
    at = draw.randrange(values.size)
    values.reshape(-1)[at] = draw.choice([np.nan, np.inf, -np.inf] if values.dtype.kind == "f" else
                                         [-1, -(2**63), 2**63 - 1])
    file[name][...] = values


def reverse(file, name, draw):
    file[name][...] = file[name][()][::-1] if draw.random() < 0.5 else np.full_like(file[name][()], 7)


def link_softly(file, name, draw):
    file.move(name, "/moved")
    file[name] = h5py.SoftLink(draw.choice(["/moved", name, "/nowhere"]))


def link_group_softly(file, name, draw):
    group = name.rsplit("/", 1)[0]
    file.move(group, "/moved")
    file[group] = h5py.SoftLink("/moved")


def link_outside(file, name, draw):
    del file[name]
    file[name] = h5py.ExternalLink(draw.choice(["../other.h5", "/dev/zero", "/etc/passwd"]), name)


def store_outside(file, name, draw):
    dataset = file[name]
    shape, kind = dataset.shape, dataset.dtype
    del file[name]
    file.create_dataset(name, shape, kind, external=[("/etc/passwd", 0, h5py.h5f.UNLIMITED)])


def make_virtual(file, name, draw):
    shape, kind = file[name].shape, file[name].dtype
    layout = h5py.VirtualLayout(shape, kind)
    layout[...] = h5py.VirtualSource(draw.choice(["../other.h5", ".", "/etc/passwd"]), name, shape, kind)
    del file[name]
    file.create_virtual_dataset(name, layout)


def make_chunks(file, name, draw):
    values = file[name][()]
    options = draw.choice([{}, {"compression": "gzip"}, {"fletcher32": True}, {"shuffle": True}])
    del file[name]
    file.create_dataset(name, data=values, chunks=values.shape or None, **options)


def make_huge(file, name, draw):
    """An extent without numbers behind it: terabytes of memory for whoever believes it."""
    shape, kind = file[name].shape, file[name].dtype
    shape = (draw.choice([10**6, 2**36, 2**44]), *shape[1:])
    del file[name]
    file.create_dataset(name, shape, kind, **draw.choice([{}, {"chunks": (1, *shape[1:])}]))


def ask_for_filter(file, name, draw):
    shape, kind = file[name].shape, file[name].dtype
    del file[name]
    creation = h5py.h5p.create(h5py.h5p.DATASET_CREATE)
    creation.set_chunk(shape)
    creation.set_filter(32015, h5py.h5z.FLAG_OPTIONAL, ())
    h5py.h5d.create(file.id, name.encode(), h5py.h5t.py_create(kind), h5py.h5s.create_simple(shape), creation)


OF_ARRAYS = [remove, make_group, add_axis, flatten, add_rows, remove_row, remove_rows, widen, change_type, make_texts,
             make_empty, spoil, reverse, link_softly, link_group_softly, link_outside, store_outside, make_virtual,
             make_chunks, make_huge, ask_for_filter]


def remove_attribute(file, owner, name, draw):
    del file[owner].attrs[name]


def set_attribute(file, owner, name, value, **options):
    attributes = file[owner].attrs
    del attributes[name]
    attributes.create(name, value, **options)


def make_list_of_texts(file, owner, name, draw):
    texts = np.array(["A" * draw.choice([1, 64, 5000])] * draw.choice([2, 100]), dtype=object)
    set_attribute(file, owner, name, texts, dtype=h5py.string_dtype())


def make_no_texts(file, owner, name, draw):
    set_attribute(file, owner, name, np.zeros((0,), dtype=object), dtype=h5py.string_dtype())


def make_list_of_fixed_texts(file, owner, name, draw):
    set_attribute(file, owner, name, np.array([b"A" * 30] * 50))


def make_list_of_numbers(file, owner, name, draw):
    set_attribute(file, owner, name, np.arange(draw.choice([2, 1000])))


def make_number(file, owner, name, draw):
    set_attribute(file, owner, name, draw.choice([1.5, np.float32(2.0), np.int8(3), np.uint64(2**64 - 1)]))


def make_sequence(file, owner, name, draw):
    values = np.empty(1, dtype=object)
    values[0] = np.arange(100)
    set_attribute(file, owner, name, values, dtype=h5py.vlen_dtype(np.dtype("i8")))


def make_reference(file, owner, name, draw):
    set_attribute(file, owner, name, file["/"].ref, dtype=h5py.ref_dtype)


def make_nothing(file, owner, name, draw):
    set_attribute(file, owner, name, h5py.Empty("f8"))


def make_foreign_text(file, owner, name, draw):
    set_attribute(file, owner, name, draw.choice(["", "x" * 10**6, "\u202e\x1b[31m", "0123456789abcdeF"]))


OF_ATTRIBUTES = [remove_attribute, make_list_of_texts, make_no_texts, make_list_of_fixed_texts, make_list_of_numbers,
                 make_number, make_sequence, make_reference, make_nothing, make_foreign_text]
