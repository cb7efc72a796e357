#pragma once
// Values as fields of CSV (RFC 4180).

#include <string>
#include <string_view>

namespace substep {

/// The shortest text that reads back to the same double; "nan", "inf" and "-inf" for the others.
std::string csv_number(double x);

/// A name as one field: quoted if it has a comma, a quote or a line break.
std::string csv_field(std::string_view text);

}  // namespace substep
