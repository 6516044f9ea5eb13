# Doxygen reads headers through this: a comment above a header's namespace speaks of the header, and not of the
# namespace that all headers share. The blank line before it becomes "/// @file"; lines keep their numbers.
NR > 1 {
  if (!settled && held == "" && /^\/\/\//) {
    held = "/// @file"
    settled = 1
  }
  print held
}
/^namespace/ { settled = 1 }
{ held = $0 }
END { print held }
