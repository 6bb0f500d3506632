#!/bin/bash
# Runs one entry of a sweep per task of a job array. Arguments: number to add to the task's index, then the command of a task.
# Edit a copy of this script and name it with --template. Options of the command line override those of #SBATCH lines.
#SBATCH --open-mode=append
#SBATCH --cpus-per-task=1

exec "${@:2}" --entry $((SLURM_ARRAY_TASK_ID + $1)) --threads "${SLURM_CPUS_PER_TASK:-1}"
