#include "export/export.h"

#include "base/file_name.h"
#include "export/formats.h"

#include <stddef.h>

static const ExportFormat *const FORMATS[] = {
#define FORMAT(name) &name##_format,
    EXPORT_FORMATS(FORMAT)
#undef FORMAT
};

enum { FORMAT_COUNT = (int)(sizeof FORMATS / sizeof FORMATS[0]) };
const ExportFormat *export_format(const char *file)
{
    for (int i = 0; i < FORMAT_COUNT; i++) {
        if (file_name_ends(file, FORMATS[i]->ending)) {
            return FORMATS[i];
        }
    }
    return NULL;
}

int export_format_count(void)
{
    return FORMAT_COUNT;
}

const ExportFormat *export_format_at(int index)
{
    return FORMATS[index];
}
