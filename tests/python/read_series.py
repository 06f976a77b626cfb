"""Prints every dataset that h5py finds in a series file, with its units, and the attributes of its root, as JSON; NaN as null."""

import json
import sys

import h5py


def without_nan(value):
    if isinstance(value, list):
        return [without_nan(item) for item in value]
    return None if value != value else value


def main(path):
    datasets = {}

    def visit(name, item):
        if isinstance(item, h5py.Dataset):
            datasets[name] = {"units": item.attrs["units"], "values": without_nan(item[()].tolist())}

    with h5py.File(path, "r") as file:
        file.visititems(visit)
        datasets["/"] = dict(file.attrs)
    json.dump(datasets, sys.stdout)


main(sys.argv[1])
