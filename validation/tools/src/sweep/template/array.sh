#!/bin/bash
# Written by bagnold; runs one entry of the sweep's manifest a task. Edit a copy of this template and name it with
# --template; the words in braces are filled in by bagnold.
#SBATCH --job-name="{{ name }}"
#SBATCH --array={{ array }}
#SBATCH --cpus-per-task={{ cpus }}
#SBATCH --output="{{ logs }}/%A_%a.log"
#SBATCH --open-mode=append
{%- if partition %}
#SBATCH --partition={{ partition }}
{%- endif %}
{%- if time %}
#SBATCH --time={{ time }}
{%- endif %}
{%- if memory %}
#SBATCH --mem={{ memory }}
{%- endif %}

exec {{ program }} --quiet sweep task {{ folder }} --entry $((SLURM_ARRAY_TASK_ID + {{ offset }})) --threads {{ cpus }}
