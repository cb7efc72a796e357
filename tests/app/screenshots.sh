#!/usr/bin/env bash
# Pictures of every panel and card, in both themes, at common window sizes and pixel ratios:
#   tests/app/screenshots.sh [FOLDER] [NAME...]
# They are written to build/screenshots for review; nothing is compared. With names, only those are made.
# Needs build/release/bin/substep-native and Xvfb (software OpenGL will do).
set -euo pipefail
cd "$(dirname "$0")/../.."
out=${1:-build/screenshots}
only=" ${*:2} "
mkdir -p "$out"
bad=$(mktemp --suffix=.json)
wild=$(mktemp --suffix=.json)
trap 'rm -f "$bad" "$wild"' EXIT
echo '{"format": "substep-scene", "version": 1, "name": "x", "bodies": [{"mass": -1}]}' >"$bad"

# An explicit gyroscopic torque at this speed gains energy without bound.
sed -e 's/"implicit"/"explicit"/; s/"mode": "adaptive"/"mode": "none"/' \
  -e 's/"angular_velocity": .*/"angular_velocity": [300, 2000, 100]/' scenes/spinning_top.json >"$wild"

# picture NAME ARGUMENT...: once per display and theme
displays=("1280x720 1" "1920x1080 1" "390x844 2" "1280x720 1.5")
picture() {
  local name=$1 display size ratio theme
  shift
  [[ $only == *" $name "* || $only == "  " ]] || return 0
  for display in "${displays[@]}"; do
    read -r size ratio <<<"$display"
    for theme in dark light; do
      local file=$out/$name-$size@$ratio-$theme.png
      local light=()
      [ "$theme" = light ] && light=(--light)
      xvfb-run -a -s "-screen 0 3840x2160x24" build/release/bin/substep-native --scenes scenes \
        --size "$size" --scale "$ratio" "${light[@]}" --screenshot "$file" "$@"
      echo "$file"
    done
  done
}

box=(--scene swinging_box --frames 90)
compared=(--set "compare=mode:none;mode:damping" --frames 60)
picture plots "${box[@]}" --set panel=plots
picture controls "${box[@]}" --set panel=controls --set more=on
picture why "${box[@]}" --set panel=why
picture ghosts --scene swinging_box "${compared[@]}" --set panel=compare
picture split --scene swinging_box "${compared[@]}" --set panel=compare --set views=split
picture split_bridge --scene bridge --set compare=mode:none --set views=split --frames 60 \
  --set panel=plots
picture split_four --scene heavy_stack --frames 40 --set views=split --set panel=plots \
  --set "compare=mode:none;mode:damping;solver:pgs"
picture tour --set tour=2 --frames 60
picture accuracy --scene pendulum --set accuracy=run --set panel=accuracy --frames 240
picture stages --scene bridge --set panel=accuracy --set accuracy=stages --set accuracy=measure \
  --frames 300
picture effects --scene bridge --set panel=controls --set more=on --set accuracy=measure \
  --frames 300
picture selection "${box[@]}" --set select=box --set forces=on
picture shown --scene bridge --frames 60 --set select=plank_5 --set forces=on --set contacts=on \
  --set frames=on --set errors=on --set axes=on
picture share "${box[@]}" --set menu=share
picture help "${box[@]}" --set help=on
picture errors "${box[@]}" --open "$bad"
picture failure --scene swinging_box --set mode=none --frames 60
picture stopped --scene "$wild" --frames 60
for scene in wrecking_ball card_house ragdoll_drop wall; do
  picture "$scene" --scene "$scene" --frames 90 --bare
done
