"""A plugin of napari: reads volumes and stores, lists the objects of a volume beside the picture, shows each at its best isovalue.

Written for napari 0.4.19 to 0.6 and its plugin engine npe2; ``napari.yaml`` says what it contributes.
"""
