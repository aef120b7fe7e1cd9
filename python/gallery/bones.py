"""CT of a head: skin and skull at the isovalues that show each best, and a model of the skull to print."""
import sys

import isoatlas

atlas = isoatlas.open(sys.argv[1])
print(f"{len(atlas.objects)} lines in the table, {atlas.objects.total:,} objects with noise")
skin = next(one for one in atlas.objects if one.outline or one.number == 1)
bone = max(atlas.objects, key=lambda one: one.best_tau if one.main_branch else 0)
print(f"skin at {skin.best_tau:g}, bone at {bone.best_tau:g}: {bone.measure:,.0f} {atlas.info['measure_unit']}, {bone.tunnels} openings")
skull = bone.surface()
skull.verify()
skull.save("skull.stl")
picture = isoatlas.render([skin.surface(), skull], opacities=[0.3, 1.0], colours=[skin.colour, (235, 225, 200)], size=480)
isoatlas.save_image(sys.argv[2], picture)
