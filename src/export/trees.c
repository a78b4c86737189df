// Out-trees. SWC and JSON hold one tree: several go to FILE-OBJECT each. GraphML holds all.
#include "export/formats.h"

#include "export/asset_path.h"
#include "outtree/out_tree_io.h"

#include <stdlib.h>

static int count_trees(const ExportSource *source, Error *e)
{
    int count = 0;
    for (int i = 0; i < source->object_count; i++) {
        count += source->tree[i] != NULL;
    }
    if (count == 0) {
        error_set(e, ERROR_INPUT,
                  "no object of '%s' grows; out-trees need a tree or another growing thing",
                  source->title);
    }
    return count;
}

static bool write_each(const ExportSource *source, const char *file, const Run *run, Error *e)
{
    int count = count_trees(source, e);
    bool done = count > 0;
    for (int i = 0; done && i < source->object_count; i++) {
        if (source->tree[i] && run_is_cancelled(run)) {
            done = run_cancel_error(e);
        } else if (source->tree[i]) {
            char *own = count == 1 ? NULL : asset_of_object(file, source->object_name[i], e);
            done = (count == 1 || own) && out_tree_write(source->tree[i], own ? own : file, e);
            free(own);
        }
    }
    return done;
}

static bool write_graphml(const ExportSource *source, const char *file, const Run *run, Error *e)
{
    if (run_is_cancelled(run)) {
        return run_cancel_error(e);
    }
    return count_trees(source, e) > 0 && out_trees_write_graphml(source->tree, source->object_name,
                                                                 source->object_count, file, e);
}

const ExportFormat swc_format = {".swc", "an out-tree: nodes with radius and parent", 0,
                                 EXPORT_TREES, write_each};
const ExportFormat json_format = {".json", "an out-tree with all that is known of it", 0,
                                  EXPORT_TREES, write_each};
const ExportFormat graphml_format = {".graphml", "all out-trees as graphs", 0, EXPORT_TREES,
                                     write_graphml};
