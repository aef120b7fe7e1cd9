"""Samples of phantoms, and the cells between them."""
import numpy


def phantom(run, name, size, seed=1):
    run("phantom", name, "--size", size, "--seed", seed, "-o", "field.npy")
    return numpy.load("field.npy").astype(float)


def cells_of(samples):
    """Lowest and highest sample of every cell, of a row, a slice or a volume; arrays of their places."""
    corners = []
    for at in numpy.ndindex(*[2] * samples.ndim):
        corners.append(samples[tuple(slice(i, n - 1 + i) for i, n in zip(at, samples.shape))])
    return numpy.min(corners, axis=0), numpy.max(corners, axis=0)


def active(low, high, tau):
    return (low < tau) & (tau <= high)
