"""The criticality tree as a graph: how many objects merge at each isovalue."""
import networkx

import isoatlas

atlas = isoatlas.open(isoatlas.phantom("demo", 48))
graph = atlas.tree.to_networkx()
print(f"{len(graph)} events; the longest way to the root has {networkx.dag_longest_path_length(graph)} steps")
merges = [values for _, values in graph.nodes(data=True) if values["kind"] == "merge"]
for values in sorted(merges, key=lambda values: -int(values["object_voxels"]))[:5]:
    print(f"at {values['value']:g}: an object of {values['object_voxels']:,} voxels with {values['tunnels']} tunnels")
