#!/usr/bin/python3
"""arrays.py NAME: NAME.h5 by h5py and NAME.mat by SciPy against NAME.csv, which hold the same rows."""
import csv
import sys

import h5py
import numpy
import scipy.io

name = sys.argv[1]
decimals = [6, 6, 6, 6, 4, 3, 3, 3]
units = ["s", "L/min", "L/min", "L/min", "bar", "N", "N", "N"]
with open(f"{name}.csv", encoding="utf-8", newline="") as file:
    header, *lines = csv.reader(file)
mat = scipy.io.loadmat(f"{name}.mat", squeeze_me=True)
with h5py.File(f"{name}.h5", "r") as hdf5:
    assert sorted(hdf5) == sorted(header), sorted(hdf5)
    assert {key for key in mat if not key.startswith("__")} == {*header, "estimate_units", "status_names"}, sorted(mat)
    for k, column in enumerate(header[:-1]):
        expected = numpy.array([float(line[k]) if line[k] else numpy.nan for line in lines])
        values = hdf5[column][:]
        assert values.dtype == numpy.float64 and values.shape == expected.shape, (column, values.dtype, values.shape)
        assert numpy.array_equal(numpy.isnan(values), numpy.isnan(expected)), column
        assert numpy.nanmax(numpy.abs(values - expected)) <= 0.501 * 10.0 ** -decimals[k], column
        assert numpy.array_equal(mat[column], values, equal_nan=True), column
        assert hdf5[column].attrs["units"].decode() == units[k], column
        assert mat["estimate_units"][column].item() == units[k], column
    status = hdf5["status"]
    masks, meanings = status.attrs["flag_masks"], status.attrs["flag_meanings"].decode().split()
    assert len(masks) == len(meanings)
    words = status[:]
    assert words.dtype == numpy.uint32 and numpy.array_equal(mat["status"], words)
    for mask, meaning in zip(masks, meanings):
        assert mat["status_names"][int(mask).bit_length() - 1].strip() == meaning, meaning
    texts = {word: "|".join(meaning for mask, meaning in zip(masks, meanings) if word & mask) for word in numpy.unique(words)}
    assert [texts[word] for word in words] == [line[-1] for line in lines]
    print(f"{name}: {len(lines)} rows alike in HDF5, MATLAB and CSV, {len(texts)} different status words;",
          {key: value.decode() for key, value in hdf5.attrs.items()})
