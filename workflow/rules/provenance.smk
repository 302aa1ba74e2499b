# How long it took, what was made from what, and what came out.


rule tabulate_timings:
    input:
        results=STUDY_RESULTS,
    output:
        "results/tables/timings.csv",
    log:
        "results/logs/tabulate_timings.log",
    params:
        code=code_of("tabulate_timings"),
        benchmarks=lambda wildcards: benchmarks(),
    shell:
        "sedfiber tabulate_timings {params.benchmarks} -o {output} > {log} 2>&1"


rule write_manifest:
    input:
        results=STUDY_RESULTS,
        timings=rules.tabulate_timings.output,
        lock=here(BASE / "envs/requirements.lock"),
    output:
        "results/manifest.json",
    log:
        "results/logs/write_manifest.log",
    params:
        code=code_of("write_manifest"),
        settings=as_json({"config": config, "commit": commit()}),
        snakefile=here(BASE / "Snakefile"),
        configfiles=[str(path) for path in workflow.configfiles],
    shell:
        "snakemake --snakefile {params.snakefile} --configfile {params.configfiles}"
        " --rulegraph dot 2> {log} | "
        "sedfiber write_manifest --settings {params.settings:q} --lock {input.lock}"
        " --rule-graph - --outputs {input.results} {input.timings} -o {output} >> {log} 2>&1"
