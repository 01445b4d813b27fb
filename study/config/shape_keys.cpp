// The keys of what links are drawn as.
#include "study/config/model_keys.h"

namespace linkstudy {

Fields<Solid> shape_fields() {
  using enum SolidKind;
  const std::string kind = "kind";
  Fields<Solid> solid;
  solid.add(kind, &Solid::kind, {.meaning = "the solid", .required = true});
  const auto add_face = [&](const char* key, Eigen::Vector3d Solid::*face, bool required) {
    solid.add(key, face,
              {.meaning = "middle of a face in the link frame",
               .unit = "m",
               .required = required,
               .counts = {3},
               .only = only_where(kind, {cylinder})});
  };
  add_face("begin", &Solid::begin, false);
  add_face("end", &Solid::end, true);
  solid.add("diameter", &Solid::diameter,
            {.meaning = "diameter",
             .unit = "m",
             .range = kPositive,
             .required = true,
             .only = only_where(kind, {cylinder, sphere})});
  solid.add("sides", &Solid::sides,
            {.meaning = "lengths of the edges along x, y and z of the solid",
             .unit = "m",
             .range = kPositive,
             .required = true,
             .counts = {3},
             .only = only_where(kind, {box})});
  solid.add("position", [](Solid& to) -> Eigen::Vector3d& { return to.frame.position; },
            {.meaning = "middle of the solid in the link frame",
             .unit = "m",
             .counts = {3},
             .only = only_where(kind, {box, sphere})});
  solid.include(&Solid::frame, rotation_fields(only_where(kind, {box})));
  return solid;
}

}  // namespace linkstudy
