# Runs after all tasks, however they ended; names what is missing.
"$ramify" batch merge "$folder" --threads "$SLURM_CPUS_PER_TASK" --quiet
