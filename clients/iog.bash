# Completes the command line of iog in bash. `iog __complete WORD...` prints the candidates for the last word, and
# patterns of files, which begin with `*`.
_iog() {
  local word=${COMP_WORDS[COMP_CWORD]#=} each offered
  COMPREPLY=()
  mapfile -t offered < <("$1" __complete "${COMP_WORDS[@]:1:COMP_CWORD}" 2>/dev/null)
  for each in "${offered[@]}"; do
    if [[ $each == \** ]]; then
      compopt -o filenames
      mapfile -t -O "${#COMPREPLY[@]}" COMPREPLY < <(compgen -f -X "!$each" -- "$word"; compgen -d -- "$word")
    elif [[ $each == "$word"* ]]; then
      COMPREPLY+=("$each")
    fi
  done
}
complete -F _iog iog
