#!/usr/bin/env bash
# The step doctor over the models of a repository, in the current folder. The environment has the
# inputs of action.yml in capitals. Exit code: 0, or 1 if a model fails, cannot be read, or none
# matches.
set -euo pipefail
shopt -s nullglob globstar
export LC_ALL=C

# A text of one line for a workflow command, or for a property of one.
message() { local t=${1//'%'/%25}; t=${t//$'\r'/%0D}; printf '%s' "${t//$'\n'/%0A}"; }
property() { local t; t=$(message "$1"); t=${t//:/%3A}; printf '%s' "${t//,/%2C}"; }
# A text for a cell of a Markdown table.
cell() {
  local t=${1//$'\n'/ }
  # Quoted, since "&" may stand for what was found.
  t=${t//'&'/'&amp;'} t=${t//'<'/'&lt;'} t=${t//'|'/'&#124;'} t=${t//'`'/'&#96;'}
  t=${t//'['/'&#91;'} t=${t//'*'/'&#42;'}
  printf '%s' "${t//'_'/'&#95;'}"
}

program=$SUBSTEP
if [ -z "$program" ]; then
  root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../../.." && pwd)
  CI=true "$root/dev" cli --version
  program=$root/build/release/bin/substep
fi

flags=(--engine "$ENGINE" --step "$STEP")
if [ "$HELD" != 0 ]; then flags+=(--held "$HELD"); fi
if [ "$RUNS" != true ]; then flags+=(--no-runs); fi

models=()
IFS=''  # patterns may have blanks
while read -r pattern; do
  for file in $pattern; do
    if [ -f "$file" ]; then models+=("./$file"); fi
  done
done <<<"$MODELS"
if [ ${#models[@]} -eq 0 ]; then
  echo "::error::No file matches the input 'models'"
  exit 1
fi

summary=${GITHUB_STEP_SUMMARY:-/dev/null}
printf '%s\n' '| model | answer |' '|---|---|' >>"$summary"
words=(holds 'holds narrowly' fails 'not understood')
failed=0
for model in "${models[@]}"; do
  name=${model#./}
  out=$FOLDER/$name
  mkdir -p "$(dirname "$out")"
  code=0
  text=$("$program" doctor "$model" "${flags[@]}" --json "$out.json" --html "$out.html" \
    --badge "$out.svg" 2>&1) || code=$?
  printf '%s\n' "::group::$(message "$name: ${words[code]:-exit code $code}")"
  sed 's/^/| /' <<<"$text"  # a line that begins with "::" would be a command
  echo '::endgroup::'
  answer=$(grep -m 1 -e '^Largest step' -e '^No limit' <<<"$text" || tail -n 1 <<<"$text")
  printf '| %s | %s: %s |\n' "$(cell "$name")" "${words[code]:-exit code $code}" "$(cell "$answer")" >>"$summary"
  level=error
  if [ "$code" -eq 0 ]; then continue; fi
  if [ "$code" -eq 1 ] && [ "$NARROW" != true ]; then level=warning; else failed=1; fi
  printf '%s\n' "::$level file=$(property "$name")::$(message "A step of $STEP s in $ENGINE ${words[code]:-exit code $code}. $answer")"
done
exit "$failed"
