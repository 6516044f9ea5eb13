#!/usr/bin/env bash
# Makes the library's thumbnails from pictures of the documents, which the program made: studio/web/presets/make.sh.
# Each line: a rule set, a picture, and what of it is shown: the left and the upper edge and the width in hundredths.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../../../docs"
while read -r name picture left top width; do
  read -r across up < <(oiiotool --info "$picture" | sed 's/.*: *\([0-9]*\) x *\([0-9]*\),.*/\1 \2/')
  wide=$((across * width / 100))
  high=$((wide * 132 / 208))
  from=$((up * top / 100))
  [ $((from + high)) -le "$up" ] || from=$((up - high))
  oiiotool "$picture" --ch R,G,B --cut "${wide}x$high+$((across * left / 100))+$from" --resize 208x132 \
    --eraseattrib ".*" --compression jpeg:82 -o "../studio/web/presets/$name.jpg"
done <<'ROWS'
bare_tree images/figure_18.png 1 12 24
branch_shell images/branch_shell.png 15 8 70
broadleaf images/broadleaf.png 12 8 76
closed_venation images/closed_leaf.png 10 30 80
cobbles images/cottage.png 0 65 40
column_climber_helix images/figure_3.png 69 22 27
column_climber_near images/figure_3.png 36 22 27
column_climber_up images/figure_3.png 4 22 27
coral images/coral.png 28 20 46
courtyard_vine images/courtyard.png 20 15 60
crevice_ivy images/ivy_in_cracks.png 20 15 60
cypress gallery/tree_gen_cypress.png 0 12 100
distributaries images/delta.png 10 10 80
drainage images/massif.png 5 0 90
fir gallery/tree_gen_fir.png 0 12 100
flat_walk images/flat_walk.png 53 32 26
flowering_plant images/clusters.png 56 14 44
fracture images/split_boulder.png 35 14 29
frost images/frost_pane.png 20 46 60
hornbeam images/hedge.png 12 8 76
ivy images/ruin.png 20 15 60
lightning images/lightning.png 40 10 60
line_tracker images/gable.png 36 15 27
meadow images/cottage.png 35 80 30
moss images/moss.png 30 10 60
pachira images/pachira.png 0 12 100
paving images/paving.png 15 20 65
roads images/roads.png 15 15 70
sea_fan images/coral.png 36 2 36
shingles images/cottage.png 20 15 50
shy_shrub images/shy_shrubs.png 20 30 32
sketch_limbs images/gable.png 3 15 27
surface_discharge images/lightning_on_body.png 15 10 70
topiary images/animal_tree.png 12 8 76
tracery images/whorls.png 75 76 25
tree_roots images/roots.png 0 45 100
venation images/venation.png 5 15 42
vessels images/vessels.png 0 25 100
ROWS
