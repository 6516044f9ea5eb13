#!/usr/bin/env bash
# Grows the library's scenes and makes the pictures of docs/images from what the program drew: reduced by oiiotool
# (Debian: openimageio-tools) and brought to 256 colours or fewer by pngquant. Nothing else is done to them.
#
#   docs/make_pictures.sh                                  with the program that ./run builds
#   ESPALIER=build/release/espalier docs/make_pictures.sh  with one that is built already
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
for tool in oiiotool pngquant; do
  command -v $tool >/dev/null || { echo "please install $tool: apt-get install openimageio-tools pngquant" >&2; exit 1; }
done
work=out/pictures
images=docs/images
mkdir -p $work $images

work_through() {  # work_through COMMAND SCENE: into a folder of the scene's name
  local folder
  folder=$work/$(basename "$2" .yaml)
  echo "$1 $2"
  if [ -n "${ESPALIER:-}" ]; then
    "$ESPALIER" "$1" "$2" -o "$folder" --quiet
  else
    ./run espalier "$1" "$2" -o "$folder" --quiet
  fi
}
grow() { work_through grow "$1"; }
expose() { work_through expose "$1"; }

small() {  # small PICTURE NAME WIDTH [COLOURS]: docs/images/NAME.png, at most WIDTH pixels wide
  local width
  width=$(oiiotool "$1" --echo '{TOP.width}' | tail -n 1)
  [ "$width" -le "$3" ] && width=0 || width=$3
  oiiotool "$1" $([ "$width" = 0 ] || echo "--resize ${width}x0") -d uint8 -o "$work/reduced.png"
  pngquant "${4:-256}" --speed 1 --strip --force "$work/reduced.png" -o "$images/$2.png"
  rm "$work/reduced.png"
  ls -l "$images/$2.png" | awk '{print "  " $NF ": " $5 " bytes"}'
}

grow scenes/library/garden_wall.yaml
small $work/garden_wall/vines.png vines 780
small $work/garden_wall/contact_sheet.png contact_sheet 960
for kind in sky_exposure sun_exposure threshold; do small $work/garden_wall/$kind.png $kind 800; done

grow scenes/library/courtyard.yaml
small $work/courtyard/vines.png courtyard 960
for scene in paving cottage; do grow scenes/library/$scene.yaml; done
small $work/paving/vines.png paving 900
small $work/cottage/vines.png cottage 960
small $work/courtyard/contact_sheet.png courtyard_panels 1100
grow scenes/library/loggia.yaml
small $work/loggia/vines.png loggia 480
sed '/^interreflection/d' scenes/library/loggia.yaml >scenes/library/unbounced.yaml
trap 'rm -f scenes/library/{unbounced,court_volume}.yaml' EXIT
grow scenes/library/unbounced.yaml
oiiotool $work/unbounced/first_pass.png $work/loggia/first_pass.png --mosaic:pad=12 2x1 -o $work/bounced.png
small $work/bounced.png bounced 1200
sed 's/  - {kind: first_pass/  - volume\n&/' scenes/library/courtyard.yaml >scenes/library/court_volume.yaml
grow scenes/library/court_volume.yaml
oiiotool --pattern constant:color=1,1,1 1132x560 3 -o $work/volume.png
oiiotool $work/courtyard/first_pass.png --cut 560x560+380+30 $work/volume.png --paste +0+0 -o $work/volume.png
oiiotool $work/court_volume/volume.png --cut 560x560+380+30 $work/volume.png --paste +572+0 -o $work/volume.png
small $work/volume.png volume 1000
if command -v blender >/dev/null; then  # the one picture that another program draws
  ${ESPALIER:-./run espalier} grow scenes/library/courtyard.yaml --diced first_pass --obj --no-pictures --quiet -o $work/diced
  blender -b -P docs/draw_diced.py -- $work/diced/diced.obj "$PWD/$work/diced/blender.png" 4.3 5.8 8.3 -0.1 0.85 -0.2 29
  small $work/diced/blender.png diced 780
fi

# One run in three parts, drawn after each; nothing of an older program's run is gone on with.
rm -rf $work/kept
program=${ESPALIER:-./run espalier}
for iterations in 12 25 51; do
  $program grow scenes/library/garden_wall.yaml -o $work/kept --resume --iterations $iterations --no-pictures --quiet
  $program render scenes/library/garden_wall.yaml --from $work/kept --images vines -o $work/kept_$iterations --quiet
done
oiiotool $work/kept_{12,25,51}/vines.png --mosaic:pad=8 3x1 -o $work/kept_growth.png
small $work/kept_growth.png kept_growth 1040

grow scenes/library/tendril.yaml
oiiotool --pattern constant:color=1,1,1 2552x960 3 -o $work/tendril.png
oiiotool $work/tendril/sky_tables.png --resize 1582x960 $work/tendril.png --paste +0+0 -o $work/tendril.png
oiiotool $work/tendril/vines.png $work/tendril.png --paste +1592+0 -o $work/tendril.png
small $work/tendril.png tendril 1400
grow scenes/library/clusters.yaml
small $work/clusters/vines.png clusters 960
grow scenes/library/shy_shrubs.yaml
small $work/shy_shrubs/vines.png shy_shrubs 960
for scene in lightning lightning_on_body; do
  grow scenes/library/$scene.yaml
  small $work/$scene/vines.png $scene 1000
done
oiiotool $work/lightning/film_00{05,11,22}.png --mosaic:pad=6 3x1 -o $work/lightning_film.png
small $work/lightning_film.png lightning_film 980
grow scenes/library/film.yaml
oiiotool $work/film/film_00{00,14,26,38,50,62}.png --mosaic:pad=6 3x2 -o $work/film.png
small $work/film.png film 1200
grow scenes/library/gable.yaml
small $work/gable/gable.png gable 1200

# Greene's figures, each one picture, and all on one sheet.
beside() {  # beside INTO HEIGHT PICTURE...: side by side on white, each so high
  local into=$1 height=$2 at=0 picture width
  shift 2
  oiiotool --pattern constant:color=1,1,1 4000x$height 3 -o "$into"
  for picture in "$@"; do
    oiiotool "$picture" --resize "0x$height" -o $work/part.png
    width=$(oiiotool $work/part.png --echo '{TOP.width}' | tail -n 1)
    oiiotool $work/part.png "$into" --paste +$at+0 -o "$into"
    at=$((at + width + 10))
  done
  oiiotool "$into" --cut $((at - 10))x$height+0+0 -o "$into"
  rm $work/part.png
}
$program gallery -o $work/gallery --json >$work/gallery.json
mkdir -p docs/gallery
beside $work/figure_3_parts.png 640 $work/gallery/figure_3a/column_layers.png $work/gallery/figure_3/figure_3{b,c,d}.png
beside $work/figure_7_parts.png 640 $work/gallery/tendril/{sky_tables,vines}.png
small $work/gallery/figure_1/figure_1.png ../gallery/figure_1 560 128
small $work/gallery/figure_2/figure_2.png ../gallery/figure_2 800 64
small $work/figure_3_parts.png ../gallery/figure_3 900
small $work/gallery/garden_wall/vines.png ../gallery/figure_4 560
small $work/gallery/courtyard/vines.png ../gallery/figure_5 640
small $work/gallery/courtyard/contact_sheet.png ../gallery/figure_6 840
small $work/figure_7_parts.png ../gallery/figure_7 860 128
small $work/gallery/clusters/vines.png ../gallery/figure_8 640
small $work/gallery/gable/gable.png ../gallery/figure_9 840
small $work/gallery/gallery.png ../gallery/gallery 1100
# The other documents' figures, those of several pictures side by side.
while read -r name pictures; do
  set -- $(printf "$work/gallery/%s " $pictures)
  if [ $# = 1 ]; then
    small "$1" ../gallery/$name 640 128
  else
    beside $work/parts.png 420 "$@"
    small $work/parts.png ../gallery/$name 900 128
  fi
done < <(python3 - $work/gallery.json <<'END'
import json, sys
for figure in json.load(open(sys.argv[1]))["figures"]:
    if figure["document"] != "greene_1989":
        print(figure["name"], *figure["pictures"])
END
)

grow scenes/library/w_dome.yaml
small $work/w_dome/steps.png colonization_steps 1600
small $work/w_dome/vines.png w_dome 960
grow scenes/library/four_crowns.yaml
small $work/four_crowns/vines.png four_crowns 1100
grow scenes/library/tree_and_wall.yaml
small $work/tree_and_wall/vines.png tree_and_wall 720
grow scenes/library/lsystem_tree.yaml
small $work/lsystem_tree/vines.png lsystem_tree 720
grow scenes/library/hedge.yaml
small $work/hedge/vines.png hedge 700
grow scenes/library/roots.yaml
small $work/roots/vines.png roots 600
grow scenes/library/whorls.yaml
small $work/whorls/figure_7.png whorls 960 32
small $work/whorls/figure_8.png whorls_on_a_body 1100
small $work/whorls/fields.png fields 1100
for scene in frost_bubble frost_pane; do
  grow scenes/library/$scene.yaml
  small $work/$scene/vines.png $scene 1000
done
grow scenes/library/whorls_volume.yaml
small $work/whorls_volume/graph.png whorls_volume 1000

for tree in broadleaf simple_tree fir cypress pachira animal_tree figure_18; do grow scenes/library/$tree.yaml; done
# Side by side, for mosaics are made of cells of one width: 1493, 960 and 960 pixels.
oiiotool --pattern constant:color=1,1,1 3429x1120 3 -o $work/three_trees.png
at=0
for tree in simple_tree fir cypress; do
  oiiotool $work/$tree/vines.png --resize 0x1120 $work/three_trees.png --paste +$at+0 -o $work/three_trees.png
  at=$((at == 0 ? 1501 : 2469))
done
small $work/three_trees.png three_trees 1100
small $work/broadleaf/vines.png broadleaf 760
small $work/pachira/vines.png pachira 560
small $work/animal_tree/vines.png animal_tree 760
small $work/figure_18/vines.png figure_18 1100
for scene in split_boulder ivy_in_cracks; do grow scenes/library/$scene.yaml; done
small $work/split_boulder/steps.png split_boulder 1200
small $work/ivy_in_cracks/vines.png ivy_in_cracks 1000
for scene in massif ridges figure_16 mountain_forest; do grow scenes/library/$scene.yaml; done
small $work/massif/land.png massif 1000
beside $work/parts.png 480 $work/massif/{tree,plan}.png
small $work/parts.png massif_plan 1000
small $work/ridges/land.png ridges 900
small $work/figure_16/figure_16.png land_iterations 1200
small $work/mountain_forest/vines.png mountain_forest 1000
for scene in venation veined_branch lobed_leaf; do grow scenes/library/$scene.yaml; done
small $work/venation/vines.png venation 1000
small $work/venation/closed_leaf.png closed_leaf 460
small $work/veined_branch/vines.png veined_branch 900
small $work/lobed_leaf/leaf.png lobed_leaf 560
grow docs/first/tree.yaml
small $work/tree/vines.png first_tree 760

grow scenes/library/figure_2.yaml
small $work/figure_2/figure_2.png flat_walk 960
grow scenes/library/figure_3.yaml
small $work/figure_3/figure_3.png figure_3 960
grow scenes/library/figure_3a.yaml
small $work/figure_3a/column_layers.png column_layers 640
grow scenes/library/ruin.yaml
small $work/ruin/vines.png ruin 780

for scene in coral branch_shell roads delta; do
  grow scenes/library/$scene.yaml
  small $work/$scene/vines.png $scene 1000
done
small $work/roads/aslant.png roads_aslant 1000

grow scenes/library/vessels.yaml
small $work/vessels/vines.png vessels 540
# The surroundings of the heart, with forks as they grew and turned.
for forks in grown murray; do
  sed "s/forks: murray/forks: $forks/" rules/library/vessels.yaml >$work/vessels_$forks.rules.yaml
  sed -e "s#../meshes/#$PWD/scenes/meshes/#; s#../../rules/library/vessels#vessels_$forks.rules#" -e 's/show: .*/show: [stems]}/' \
      -e 's/^  - vines/  - {kind: vines, show: [stems]}/' -e 's/width: 720, height: 1280/width: 560, height: 560/' \
      -e 's/main: .*/main: {eye: [0.5, 1.35, 1.5], target: [0.0, 1.27, 0], fov: 14}/' \
      scenes/library/vessels.yaml >$work/vessels_$forks.yaml
  grow $work/vessels_$forks.yaml
done
oiiotool $work/vessels_grown/vines.png $work/vessels_murray/vines.png --mosaic:pad=8 2x1 -o $work/murray.png
small $work/murray.png murray 1128

for recipe in docs/examples/*.yaml; do
  name=$(basename $recipe .yaml)
  grow $recipe
  small $work/$name/vines.png recipe_$name 620
done

[ -x build/release/tests/figures ] || ./run build
build/release/tests/figures $work
small $work/lattice_sweep.png lattice_sweep 1040
small $work/house.png house 1100
small $work/leaves.png leaves 1100
small $work/moss.png moss 960

expose scenes/library/street.yaml
small $work/street/sun_hours.png street_sun_hours 800
small $work/street/sky_exposure.png street_sky_exposure 800
small $work/street/contact_sheet.png street_contact_sheet 960

# The README's first rule file, as it stands and after each of its three steps.
changed() {  # changed NAME FROM TO [FROM TO ...]
  local name=$1 rules=$work/first_$1.yaml
  shift
  cp docs/first/vine.yaml "$rules"
  while [ $# -gt 0 ]; do
    grep -qF -- "$1" "$rules" || { echo "docs/first/vine.yaml no longer says '$1'" >&2; exit 1; }
    sed -i "s/$1/$2/" "$rules"
    shift 2
  done
  sed "s#rules: vine.yaml#rules: first_$name.yaml#" docs/first/scene.yaml >"$work/try_$name.yaml"
  grow "$work/try_$name.yaml"
}
changed as_is
up=('up: 0.08' 'up: 0.4') far=('max: 3}' 'max: 12}') autumn=('size: 1.2' 'size: 2' '#4f7a2c' '#b3412a')
changed up "${up[@]}"
changed far "${up[@]}" "${far[@]}"
changed autumn "${up[@]}" "${far[@]}" "${autumn[@]}"
oiiotool $work/try_{as_is,up,far,autumn}/vines.png --mosaic:pad=8 2x2 -o $work/first_vines.png
small $work/first_vines.png first_vines 760
