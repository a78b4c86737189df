// Materials.
#include "render/material/material.h"
#include "render/material/thin_film.h"
#include "scene/builtin.h"
#include "scene/spec_check.h"

#define BIT(kind) (1u << (kind))
#define ALL_BUT(kinds) (~(kinds))
#define COLOURED ALL_BUT(BIT(MATERIAL_EMISSION))
#define FILM BIT(MATERIAL_THIN_FILM)
#define PATTERNED ALL_BUT(BIT(MATERIAL_EMISSION) | BIT(MATERIAL_DIELECTRIC) | FILM)
#define BUMPED (PATTERNED | BIT(MATERIAL_DIELECTRIC))

#define KIND(NAME, name) {#name, MATERIAL_##NAME},
static const EnumName KINDS[] = {MATERIAL_KINDS(KIND){0}};
#undef KIND
static const EnumName PATTERNS[] = {
    {"none", PATTERN_NONE},         {"bark", PATTERN_BARK},   {"ground", PATTERN_GROUND},
    {"leaf", PATTERN_LEAF},         {"noise", PATTERN_NOISE}, {"corallite", PATTERN_CORALLITE},
    {"youth", PATTERN_YOUTH},       {"sand", PATTERN_SAND},   {"mountain", PATTERN_MOUNTAIN},
    {"badlands", PATTERN_BADLANDS}, {"water", PATTERN_WATER}, {0}};

static const Key MATERIAL_KEYS[] = {
    {KEY_OF(Material, name, "name", KEY_NAME), .flags = KEY_REQUIRED, .count = 64,
     .doc = "What objects call it. The name of a built-in material changes that one, and starts "
            "from its values."},
    {KEY_OF(Material, kind, "kind", KEY_ENUM), .names = KINDS,
     .doc =
         "diffuse: matt; conductor: metal; dielectric: glass or ice; principled: matt under a "
         "coat, or metallic; leaf: a thin sheet that lets light through; emission: shines, closed "
         "meshes and curves outward, sheets to both sides; thin_film: a soap bubble's, clear, with "
         "interference colours."},
    {KEY_OF(Material, color, "color", KEY_COLOR), .kinds = COLOURED, .high = 1,
     .doc = "Reflectance (of a leaf's upper side; the tint of what passes a dielectric)."},
    {KEY_OF(Material, color2, "color2", KEY_COLOR), .kinds = PATTERNED, .high = 1,
     .doc = "The pattern's second colour: furrows, soil, veins."},
    {KEY_OF(Material, transmittance, "transmittance", KEY_COLOR), .kinds = BIT(MATERIAL_LEAF),
     .high = 1, .doc = "Colour of the light that a leaf lets through."},
    {KEY_OF(Material, absorption, "absorption", KEY_COLOR), .kinds = BIT(MATERIAL_DIELECTRIC),
     .high = 1e6, .unit = "1/m", .doc = "How fast light fades inside (Beer-Lambert)."},
    {KEY_OF(Material, scattering, "scattering", KEY_COLOR), .kinds = BIT(MATERIAL_DIELECTRIC),
     .high = 1e6, .unit = "1/m", .doc = "How fast light is turned aside inside: milk, flesh, ice."},
    {KEY_OF(Material, anisotropy, "anisotropy", KEY_FLOAT), .kinds = BIT(MATERIAL_DIELECTRIC),
     .low = -0.98, .high = 0.98,
     .doc = "Mean cosine of that scattering: 0 = to all sides, near 1 = forward, as flesh does."},
    {KEY_OF(Material, roughness, "roughness", KEY_FLOAT), .kinds = COLOURED & ~FILM, .high = 1,
     .doc = "How rough the surface is: 0 = a mirror or a clear pane, 1 = matt."},
    {KEY_OF(Material, metallic, "metallic", KEY_FLOAT), .kinds = BIT(MATERIAL_PRINCIPLED),
     .high = 1, .doc = "0 = no metal, 1 = metal."},
    {KEY_OF(Material, specular, "specular", KEY_FLOAT),
     .kinds = BIT(MATERIAL_PRINCIPLED) | BIT(MATERIAL_LEAF), .high = 1,
     .doc = "Strength of the glossy coat; 0.5 = an index of 1.5."},
    {KEY_OF(Material, ior, "ior", KEY_FLOAT), .kinds = BIT(MATERIAL_DIELECTRIC) | FILM, .low = 1,
     .high = 5, .doc = "Index of refraction; 1 = no surface, light goes straight in and out."},
    {KEY_OF(Material, radiance, "radiance", KEY_COLOR), .kinds = BIT(MATERIAL_EMISSION),
     .high = 1e12, .unit = "W/(m^2 sr)",
     .doc = "Light that it sends out, per area and solid angle."},
    {KEY_OF(Material, film_thickness, "film_thickness", KEY_FLOAT), .kinds = FILM,
     .high = (double)THIN_FILM_MOST_NM, .unit = "nm",
     .doc = "Thickness of the film where it stands upright; 0 = not to be seen."},
    {KEY_OF(Material, film_drainage, "film_drainage", KEY_FLOAT), .kinds = FILM, .high = 1,
     .doc = "How much thinner it is where it faces up, and thicker where down."},
    {KEY_OF(Material, film_swirl, "film_swirl", KEY_FLOAT), .kinds = FILM, .high = 1,
     .doc = "How far its thickness varies in streaks, about pattern_scale wide."},
    {KEY_OF(Material, pattern, "pattern", KEY_ENUM), .kinds = BUMPED, .names = PATTERNS,
     .doc = "Procedural pattern of color and color2, with bumps. bark: ridges and furrows; ground: "
            "soil and grass in patches; leaf: veins and blotches; noise: plain noise; corallite: "
            "cups of a coral; youth: color2 where a branch still grows; sand: ripples of a sea "
            "floor; mountain: rock, scree, grass and snow; badlands: coloured beds; water: "
            "ripples; none: one colour."},
    {KEY_OF(Material, pattern_scale, "pattern_scale", KEY_FLOAT), .kinds = BUMPED | FILM,
     .high = 1e6, .unit = "m",
     .doc = "Wavelength of the pattern's largest features; 0 = the pattern's own."},
    {KEY_OF(Material, pattern_depth, "pattern_depth", KEY_FLOAT), .kinds = BUMPED, .high = 1e3,
     .unit = "m", .doc = "Height of the pattern's bumps; 0 = none."},
    {KEY_OF(Material, snow_line, "snow_line", KEY_FLOAT), .kinds = PATTERNED, .high = 1,
     .doc =
         "Pattern mountain: altitude above which snow lies, a share of the land's relief; 0 = no "
         "snow."},
    {KEY_OF(Material, grass_line, "grass_line", KEY_FLOAT), .kinds = PATTERNED, .high = 1,
     .doc = "Pattern mountain: altitude below which grass grows; 0 = no grass."},
    {KEY_OF(Material, variation, "variation", KEY_FLOAT), .kinds = PATTERNED, .high = 1,
     .doc = "How far hue and brightness differ from instance to instance."},
    {KEY_OF(Material, texture, "texture", KEY_FILE), .kinds = PATTERNED,
     .doc = "Image that multiplies color (and a leaf's transmittance), by the mesh's UVs."},
    {KEY_OF(Material, alpha_texture, "alpha_texture", KEY_FILE), .kinds = COLOURED & ~FILM,
     .doc = "Image that cuts the surface out, by the mesh's UVs."},
    {0},
};

static void material_defaults(const Node *given, int kind, void *out)
{
    Material *material = out;
    const char *name = node_get_text(given, "name");
    const Material *builtin = name ? builtin_material(name) : NULL;
    if (builtin && (kind < 0 || builtin->kind == (MaterialKind)kind)) {
        *material = *builtin;
    } else {
        *material = material_default(kind < 0 ? MATERIAL_DIFFUSE : (MaterialKind)kind);
    }
}

const Table material_table = {
    .name = "material",
    .doc = "What a surface is made of. Objects find materials by their names.",
    .example = "materials:\n"
               "  - {name: leaf, color: \"#7d8a3c\"}                               # the built-in "
               "leaf in autumn\n"
               "  - {name: gold, kind: conductor, color: [1.0, 0.71, 0.29], roughness: 0.2}\n"
               "objects:\n"
               "  - name: ball\n"
               "    material: gold\n"
               "    shape: {envelope: [{shape: sphere, size: 1, position: [0, 1, 0]}]}\n",
    .size = sizeof(Material),
    .keys = MATERIAL_KEYS,
    .kind_key = "kind",
    .kind_defaults = material_defaults};
