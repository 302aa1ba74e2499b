# The whole study as a graph of files. `snakemake -j2` makes everything; each target rule
# below makes one stage and what it needs.


configfile: "config.yaml"


include: "workflow/rules/common.smk"
include: "workflow/rules/simulations.smk"
include: "workflow/rules/dataset.smk"


rule all:
    default_target: True
    input:
        rules.simulations.input,
        rules.dataset.input,
